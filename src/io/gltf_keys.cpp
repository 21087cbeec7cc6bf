// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_keys.hpp"

#include <cmath>

namespace mien {

Keys keys_of(std::span<const double> times) {
    Keys keys;
    for (std::size_t r = 0; r < times.size(); ++r) {
        const auto time = static_cast<float>(times[r] - times.front());
        if (r > 0 && !(time > keys.times.back())) continue;
        keys.rows.push_back(r);
        keys.times.push_back(time);
    }
    return keys;
}

void append_rotation(std::vector<float>& values, const Quaternion& q) {
    const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    const std::size_t n = values.size();
    const double side =
        n == 0 ? q.w : q.x * values[n - 4] + q.y * values[n - 3] + q.z * values[n - 2] + q.w * values[n - 1];
    const double scale = (side < 0 ? -1 : 1) / norm;
    for (const double part : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(scale * part));
}

void append_translation(std::vector<float>& values, const Vec3& t) {
    const Vec3f narrow = to_float(t);
    values.insert(values.end(), {narrow.x, narrow.y, narrow.z});
}

}  // namespace mien
