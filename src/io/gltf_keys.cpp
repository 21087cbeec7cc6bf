// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_keys.hpp"

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

}  // namespace mien
