// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

#include "write_surfaces.hpp"

namespace mien::samples {

std::string format_obj(std::span<const Surface> parts) {
    std::string text =
        "# A human head, made by mien_samples of the mien project. Metres; +x left, +y up, +z out of the face.\n";
    std::size_t first = 1, first_uv = 1;
    for (const Surface& part : parts) {
        fmt::format_to(std::back_inserter(text), "o {}\n", part.name);
        for (const Vec3& p : part.positions)
            fmt::format_to(std::back_inserter(text), "v {:.6f} {:.6f} {:.6f}\n", p.x / 1000 + 0.0, p.y / 1000 + 0.0,
                           p.z / 1000 + 0.0);
        std::string faces;
        std::map<std::pair<long, long>, std::size_t> uv_number;
        for (const SurfaceFace& face : part.faces) {
            faces += "f";
            for (std::size_t k = 0; k < corner_count(face); ++k) {
                const std::pair uv{std::lround(face.uvs[k].u * 1e5), std::lround((1 - face.uvs[k].v) * 1e5)};
                const auto [entry, is_new] = uv_number.emplace(uv, first_uv);
                if (is_new) {
                    fmt::format_to(std::back_inserter(text), "vt {:.5f} {:.5f}\n", static_cast<double>(uv.first) / 1e5,
                                   static_cast<double>(uv.second) / 1e5);
                    ++first_uv;
                }
                fmt::format_to(std::back_inserter(faces), " {}/{}", face.corners[k] + first, entry->second);
            }
            faces += "\n";
        }
        text += faces;
        first += part.positions.size();
    }
    return text;
}

}  // namespace mien::samples
