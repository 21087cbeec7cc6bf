// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "shell.hpp"

#include <algorithm>
#include <cmath>

namespace mien::samples {

Shell shell_of(const Surface& surface, const std::function<bool(std::uint32_t)>& wanted) {
    const std::vector<Vec3> normals = vertex_normals(surface);
    Shell shell;
    for (std::uint32_t v = 0; v < surface.positions.size(); ++v)
        if (wanted(v)) {
            shell.places.push_back(surface.positions[v]);
            shell.normals.push_back(normals[v]);
        }
    return shell;
}

std::size_t nearest(const Shell& shell, const Vec3& place) {
    std::size_t best = 0;
    double least = 1e30;
    for (std::size_t i = 0; i < shell.places.size(); ++i) {
        const Vec3 d = place - shell.places[i];
        if (dot(d, d) < least) least = dot(d, d), best = i;
    }
    return best;
}

// The tangent planes of the nearest few vertices, weighted by nearness, are smoother than that of the nearest alone.
Vec3 raised_to(const Shell& shell, const Vec3& place, double height) {
    Vec3 p = place;
    for (int step = 0; step < 3; ++step) {
        const double reach = 2 * distance(p, shell.places[nearest(shell, p)]) + 5;
        double weights = 0, above = 0;
        Vec3 normal;
        for (std::size_t i = 0; i < shell.places.size(); ++i) {
            const Vec3 d = p - shell.places[i];
            const double t = 1 - dot(d, d) / (reach * reach);
            if (t <= 0) continue;
            weights += t * t;
            above += t * t * dot(d, shell.normals[i]);
            normal += t * t * shell.normals[i];
        }
        p += ((height - above / weights) / length(normal)) * normal;
    }
    return p;
}

Vec3 kept_off(const Shell& shell, const Vec3& place, double height) {
    const std::size_t i = nearest(shell, place);
    const double above = dot(place - shell.places[i], shell.normals[i]);
    return above < height ? place + (height - above) * shell.normals[i] : place;
}

Vec3 on_curve(const std::vector<Vec3>& points, double t) {
    const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(last);
    const auto i = std::min(static_cast<std::ptrdiff_t>(place), last - 1);
    const double s = place - static_cast<double>(i);
    const auto at = [&](std::ptrdiff_t k) {
        if (k < 0) return 2.0 * points[0] - points[1];
        if (k > last) return 2.0 * points[static_cast<std::size_t>(last)] - points[static_cast<std::size_t>(last - 1)];
        return points[static_cast<std::size_t>(k)];
    };
    const Vec3 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    return b + 0.5 * s * (c - a + s * (2.0 * a - 5.0 * b + 4.0 * c - d + s * (3.0 * (b - c) + d - a)));
}

}  // namespace mien::samples
