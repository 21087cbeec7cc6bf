// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The left half of the head as a coarse cage: a grid of 16 rows and 12 columns over face, skull and neck, in which the
// eye, the mouth, the ear and the nostril are blocks of cells replaced by concentric loops.

#include "head_cage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mien::samples {
namespace {

constexpr std::size_t columns = 12;
constexpr std::size_t rows = 16;
using Row = std::array<Vec3, columns>;

// Columns: 0 midline, 1-2 nose, 3 inner orbit and corner of the mouth block, 4 pupil, 5 outer orbit, 6 temple and jaw,
// 7-9 round the ear, 10 back, 11 midline at the back.
// Rows 0 and 1 lie on the skull's superellipsoid.
constexpr std::array<double, columns> skull_azimuth{0, 6, 13, 21, 32, 46, 64, 84, 102, 122, 150, 180};

// The cranium: a superellipsoid, rounder from above than from the side.
constexpr Vec3 skull_centre{0, 22, 2}, skull_axes{76, 89, 95};
constexpr double skull_round_above = 2.1, skull_round_up = 2.15;

// 1 on the surface, of first degree along rays from the centre.
double skull_level(const Vec3& p) {
    const Vec3 d = p - skull_centre;
    const double ring = std::pow(std::abs(d.x) / skull_axes.x, skull_round_above) +
                        std::pow(std::abs(d.z) / skull_axes.z, skull_round_above);
    return std::pow(
        std::pow(ring, skull_round_up / skull_round_above) + std::pow(std::abs(d.y) / skull_axes.y, skull_round_up),
        1 / skull_round_up);
}

Vec3 on_skull(double azimuth_degrees, double y) {
    const double ring = std::pow(1 - std::pow((y - skull_centre.y) / skull_axes.y, skull_round_up), 1 / skull_round_up);
    const double t = azimuth_degrees * std::numbers::pi / 180;
    const Vec3 ray{std::sin(t), 0, std::cos(t)};
    const double r = ring / skull_level(skull_centre + ray);
    return {r * ray.x, y, skull_centre.z + r * ray.z};
}

Row skull_row(const std::array<double, columns>& heights) {
    Row row;
    for (std::size_t c = 0; c < columns; ++c) row[c] = on_skull(skull_azimuth[c], heights[c]);
    row.front().x = row.back().x = 0;
    return row;
}

// The crown's border dips at its four corners, where its quads would otherwise have straight angles.
constexpr std::array<double, columns> crown_heights{94, 92.5, 89, 84, 89, 93, 93, 89, 84, 89, 92.5, 94};
constexpr std::array<double, columns> forehead_heights{60, 60, 59.5, 59, 60, 61, 61, 60.5, 60, 61, 62, 62};

const std::array<Row, rows>& face_rows() {
    // clang-format off
    static const std::array<Row, rows> table{{
        skull_row(crown_heights),
        skull_row(forehead_heights),
        // brow
        {{{0,24,96.2},{8,24.5,96.2},{16,26,95.2},{24.5,28,92.2},{36,30,86.2},{50,28,73.5},{61,27,49},{71,29,8},{74.5,30,-13},{73,30,-36},{50,30,-73},{0,30,-92}}},
        // nasion, upper orbit, top of the ear
        {{{0,8,91.8},{4.6,9,90.8},{9,11,88},{15,14,85.8},{31,17.5,86.2},{48,14,73},{60,14,48.5},{69.8,9,12},{72.7,17,-9},{72.5,8,-27},{52,8,-70.5},{0,6,-91}}},
        // eye
        {{{0,-4,97},{3.8,-4,95.6},{7,-3.5,91},{10.6,-2,84.6},{31,0,82},{51.5,0,65.5},{63,-1,43.5},{69.2,-6,14},{71.5,-7,-11},{71.5,-8,-29},{53,-12,-66.8},{0,-12,-88}}},
        // lower orbit
        {{{0,-17,107.2},{4.4,-17,105.8},{8.4,-17.5,99},{14.5,-17,87.5},{31,-19,83.2},{49.5,-16,72.3},{65.5,-17,42},{68.6,-21,14},{70,-22,-10},{69.5,-23,-27},{50.5,-32,-60.5},{0,-31,-80.5}}},
        // tip of the nose, cheek bone, ear lobe
        {{{0,-30.5,119.8},{6.4,-30,116.6},{15.2,-32,104.6},{18.8,-30.5,94},{33,-33,86.2},{52.5,-31,70.6},{65.8,-31,40.5},{67.4,-37,13},{68.3,-39,-8},{67,-37,-24},{48,-50,-58},{0,-49,-71}}},
        // under the nose
        {{{0,-38.8,114},{4.8,-38.6,112.8},{16,-38.2,104},{20.5,-40,93},{35,-46,85},{53.3,-44,67.3},{64,-43,37},{65.5,-46,7},{65.5,-49,-10},{62,-49,-26},{45,-62,-54},{0,-62,-63.5}}},
        // subnasale
        {{{0,-43.5,103},{6,-43.3,102.2},{13,-42.6,98.6},{22,-48,93.4},{36.5,-57,83.6},{52.3,-55,64.3},{61.8,-54,35.5},{62,-53,5},{62,-57,-11},{58.5,-58,-25},{43,-73,-50.5},{0,-74,-57.5}}},
        // mouth
        {{{0,-65,105},{7,-65,104},{18,-65,98},{33,-66,85.2},{43,-68,77.4},{51.5,-67,61.5},{58.5,-65,33.5},{57.5,-60,3},{57,-65,-12},{54,-68,-24},{41,-84,-48},{0,-86,-54.5}}},
        // mentolabial groove
        {{{0,-83,97.6},{7,-83.5,97},{15,-84,94},{26,-83.5,88},{38,-80.5,77.4},{48.3,-77,59.2},{55.2,-75,30.5},{54.5,-67,1},{53,-73,-13},{50.5,-78,-24},{39.5,-96,-47},{0,-97,-53}}},
        // pogonion
        {{{0,-97,101.6},{7.5,-97,100.6},{15,-97,96.6},{23.5,-96,88.5},{34.5,-92,75.4},{45,-87.5,56},{52.3,-83,27.5},{52.8,-74,-1},{50,-82,-14},{48,-89,-24},{38.5,-108,-47},{0,-109,-53}}},
        // menton and the edge of the jaw
        {{{0,-109.5,94.5},{7,-109.3,93.6},{14,-108,89.8},{21.5,-106,82.5},{32,-101.3,69},{41.5,-95.6,50},{49.3,-89,24},{51,-80,-4},{47.5,-91,-15},{45.5,-101,-24},{38,-121,-48},{0,-122,-54}}},
        // under the jaw
        {{{0,-114,62},{7,-114,61},{13,-113.5,58.5},{19.5,-112,54},{28,-109,45},{36,-104.5,32},{42.5,-100,15},{46,-95,-6},{45.5,-106,-16},{44,-115,-26},{37.5,-133,-50},{0,-134,-56.5}}},
        // neck
        {{{0,-128,40.5},{7.5,-128,39.8},{14,-128,37.5},{20.5,-128,34},{28,-127,27},{35.5,-126,17},{42,-124,4.5},{45.5,-122,-9},{46.5,-126,-19},{45,-132,-30},{37.5,-147,-53},{0,-148,-60}}},
        // rim of the neck
        {{{0,-170,32},{8,-170,31.2},{15.5,-170,29},{22.5,-170,25.5},{31,-170,19},{39,-170,9},{46,-170,-2},{52,-170,-14},{55,-171,-25},{53,-173,-38},{40,-176,-60},{0,-177,-68}}},
    }};
    // clang-format on
    return table;
}

// Texture layout: the grid is a rectangle, u by column from the middle outwards, v by row downwards.
constexpr std::array<double, columns> column_u{.500, .530, .560, .592, .640, .695, .750, .800, .838, .880, .935, .998};
constexpr std::array<double, rows> row_v{.280, .345, .430, .470, .520, .570, .612, .645,
                                         .675, .735, .795, .835, .870, .905, .940, .995};

struct Grid {
    std::array<std::array<std::uint32_t, columns>, rows> point{};
};

struct Hole {
    std::size_t row = 0, column = 0, height = 0, width = 0;
};
constexpr Hole eye_hole{3, 3, 2, 2};
constexpr Hole mouth_hole{8, 0, 2, 3};
constexpr Hole ear_hole{3, 7, 3, 2};
constexpr Hole nostril_hole{7, 1, 1, 1};
constexpr std::array<Hole, 4> holes{eye_hole, mouth_hole, ear_hole, nostril_hole};

bool covers_cell(const Hole& h, std::size_t r, std::size_t c) {
    return r >= h.row && r < h.row + h.height && c >= h.column && c < h.column + h.width;
}

bool covers_point(const Hole& h, std::size_t r, std::size_t c) {
    const bool inner_column = c < h.column + h.width && (c > h.column || h.column == 0);
    return r > h.row && r < h.row + h.height && inner_column;
}

Uv grid_uv(std::size_t r, std::size_t c) {
    return {column_u[c], row_v[r]};
}

Grid add_grid(Cage& cage) {
    Grid grid;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            const bool hidden =
                std::any_of(holes.begin(), holes.end(), [&](const Hole& h) { return covers_point(h, r, c); });
            grid.point[r][c] = hidden ? no_vertex : add_point(cage, face_rows()[r][c]);
        }
    for (std::size_t r = 0; r + 1 < rows; ++r)
        for (std::size_t c = 0; c + 1 < columns; ++c) {
            if (std::any_of(holes.begin(), holes.end(), [&](const Hole& h) { return covers_cell(h, r, c); })) continue;
            cage.quads.push_back(
                {{grid.point[r][c], grid.point[r + 1][c], grid.point[r + 1][c + 1], grid.point[r][c + 1]},
                 {grid_uv(r, c), grid_uv(r + 1, c), grid_uv(r + 1, c + 1), grid_uv(r, c + 1)}});
        }
    return grid;
}

// The points round a hole, from its upper left corner over the top to the right, down, back along the bottom and, where
// the hole does not lie at the midline, up again.
Loop hole_loop(const Grid& grid, const Hole& h) {
    Loop loop;
    const auto visit = [&](std::size_t r, std::size_t c) {
        loop.points.push_back(grid.point[r][c]);
        loop.uvs.push_back(grid_uv(r, c));
    };
    const std::size_t bottom = h.row + h.height, right = h.column + h.width;
    for (std::size_t c = h.column; c <= right; ++c) visit(h.row, c);
    for (std::size_t r = h.row + 1; r <= bottom; ++r) visit(r, right);
    for (std::size_t c = right; c-- > h.column;) visit(bottom, c);
    loop.closed = h.column != 0;
    if (loop.closed)
        for (std::size_t r = bottom - 1; r > h.row; --r) visit(r, h.column);
    return loop;
}

// The crown: a grid of 3 by 5 cells whose border is row 0.
void add_crown(Cage& cage, const Grid& grid) {
    constexpr std::size_t width = 3, length = 5;
    std::array<std::array<std::uint32_t, length + 1>, width + 1> point{};
    const auto& border = grid.point[0];
    for (std::size_t i = 0; i <= width; ++i) point[i][0] = border[i], point[i][length] = border[columns - 1 - i];
    for (std::size_t j = 0; j <= length; ++j) point[width][j] = border[width + j];
    const auto uv = [](std::size_t i, std::size_t j) {
        return Uv{.15 + .13 * static_cast<double>(i) / width, .01 + .25 * static_cast<double>(j) / length};
    };
    for (std::size_t j = 1; j < length; ++j)
        for (std::size_t i = 0; i < width; ++i) {
            const double s = static_cast<double>(i) / width, t = static_cast<double>(j) / length;
            const auto border_at = [&](std::size_t k, std::size_t l) { return cage.points[point[k][l]]; };
            // A Coons patch seen from above, lifted to the cranium.
            const Vec3 p = s * border_at(width, j) + (1 - t) * border_at(i, 0) + t * border_at(i, length) -
                           s * ((1 - t) * border_at(width, 0) + t * border_at(width, length));
            const double y =
                skull_centre.y +
                skull_axes.y *
                    std::pow(1 - std::pow(skull_level({p.x, skull_centre.y, p.z}), skull_round_up), 1 / skull_round_up);
            point[i][j] = add_point(cage, {i == 0 ? 0.0 : p.x, y, p.z});
        }
    for (std::size_t j = 0; j < length; ++j)
        for (std::size_t i = 0; i < width; ++i)
            cage.quads.push_back({{point[i][j], point[i + 1][j], point[i + 1][j + 1], point[i][j + 1]},
                                  {uv(i, j), uv(i + 1, j), uv(i + 1, j + 1), uv(i, j + 1)}});
    for (std::size_t j = 0; j <= length; ++j) cage.rings["crown"].push_back(point[0][j]);
}

}  // namespace

std::uint32_t add_point(Cage& cage, const Vec3& p) {
    cage.points.push_back(p);
    return static_cast<std::uint32_t>(cage.points.size() - 1);
}

std::vector<std::uint32_t> add_points(Cage& cage, const std::vector<Vec3>& points) {
    std::vector<std::uint32_t> ids;
    ids.reserve(points.size());
    for (const Vec3& p : points) ids.push_back(add_point(cage, p));
    return ids;
}

Loop add_strip(Cage& cage, const Loop& outer, const Inset& inset) {
    Loop inner{add_points(cage, inset.points), inset.uvs, outer.closed};
    const std::size_t n = outer.points.size();
    for (std::size_t i = 0; i < (outer.closed ? n : n - 1); ++i) {
        const std::size_t j = (i + 1) % n;
        cage.quads.push_back({{outer.points[i], inner.points[i], inner.points[j], outer.points[j]},
                              {outer.uvs[i], inner.uvs[i], inner.uvs[j], outer.uvs[j]},
                              inset.region});
    }
    cage.counts.push_back({outer.points[0], inner.points[0], inset.count});
    return inner;
}

std::vector<Uv> shrunk(const std::vector<Uv>& uvs, const Uv& centre, double su, double sv) {
    std::vector<Uv> result;
    result.reserve(uvs.size());
    for (const Uv& p : uvs) result.push_back({centre.u + su * (p.u - centre.u), centre.v + sv * (p.v - centre.v)});
    return result;
}

Cage head_cage() {
    Cage cage;
    const Grid grid = add_grid(cage);
    for (std::size_t r = 0; r < rows; ++r)
        cage.rings["row" + std::to_string(r)].assign(grid.point[r].begin(), grid.point[r].end());
    add_crown(cage, grid);
    // Loops of 32 round the eye: the strips that end at it are cut finer than the rest.
    const Loop orbit = hole_loop(grid, eye_hole);
    for (std::size_t i = 0; i < orbit.points.size(); ++i)
        cage.counts.push_back({orbit.points[i], orbit.points[(i + 1) % orbit.points.size()], 4});
    // The nose has finer wings than a usual cell shows.
    for (std::size_t r = 5; r < 8; ++r) cage.counts.push_back({grid.point[r][6], grid.point[r + 1][6], 4});
    for (std::size_t c = 1; c < 3; ++c) cage.counts.push_back({grid.point[14][c], grid.point[14][c + 1], 4});
    add_eye(cage, orbit);
    add_mouth(cage, hole_loop(grid, mouth_hole));
    add_ear(cage, hole_loop(grid, ear_hole));
    add_nostril(cage, hole_loop(grid, nostril_hole));
    return cage;
}

}  // namespace mien::samples
