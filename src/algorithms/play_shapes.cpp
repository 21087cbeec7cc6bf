// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/play_shapes.hpp"

#include <algorithm>
#include <cassert>

#include "algorithms/shape_table.hpp"

#include "mien/algorithms/expressions.hpp"

namespace mien {

ShapePlayer fit_shape_player(const Face& face, const ShapesOptions& options) {
    RetargetOptions retargeting;
    retargeting.method = options.method;
    ShapePlayer player{fit_retarget(neutral_take(face.points), face, retargeting), {}, {}};
    player.points = player.map.points;
    for (const NamedShape& shape : named_shapes())
        if (shape.set == ShapeSet::arkit)
            player.motions.push_back(shape.name == "jawOpen" ? jaw_open_motions(player.points)
                                                             : table_motions(shape.name, player.points));
    // The lips that mouthClose brings together are those of the table's own jawOpen.
    const auto index = [](std::string_view name) {
        const auto all = named_shapes();
        return static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(), [&](const NamedShape& s) { return s.name == name; }) - all.begin());
    };
    const std::vector<Vec3> open = table_motions("jawOpen", player.points);
    std::vector<Vec3>& close = player.motions[index("mouthClose")];
    const std::vector<Vec3>& made = player.motions[index("jawOpen")];
    for (std::size_t i = 0; i < close.size(); ++i) close[i] += open[i] - made[i];
    return player;
}

void play_shapes(const ShapePlayer& player, std::span<const float> weights, std::span<Vec3> sums,
                 std::span<Vec3f> displacements) noexcept {
    const std::size_t points = player.points.size();
    assert(weights.size() == player.motions.size() && sums.size() == 2 * points && displacements.size() == points);
    const std::span<Vec3> source = sums.first(points), target = sums.last(points);
    std::copy(player.map.source_neutral.begin(), player.map.source_neutral.end(), source.begin());
    for (std::size_t s = 0; s < weights.size(); ++s)
        for (std::size_t i = 0; i < points; ++i) source[i] += static_cast<double>(weights[s]) * player.motions[s][i];
    retarget(player.map, source, target);
    for (std::size_t i = 0; i < points; ++i) displacements[i] = to_float(target[i] - player.map.target_neutral[i]);
}

}  // namespace mien
