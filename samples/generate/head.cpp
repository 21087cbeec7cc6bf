// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Puts the parts together and names the feature points of ISO/IEC 14496-2 that the head has: all but 11.5 (it has no
// hair). 7.1, the top of the spine, is inside a head; a vertex of the nape stands in for it. 11.1 to 11.3, the hair
// line, lie where it would be.

#include "head.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "eyeball.hpp"
#include "hair.hpp"
#include "hairs.hpp"
#include "mouth_parts.hpp"
#include "paint.hpp"
#include "skin.hpp"

namespace mien::samples {
namespace {

enum PartNumber : std::size_t { skin_part, left_eye, right_eye, upper_teeth, lower_teeth, tongue_part };

struct Named {
    const char* left;   // id on the subject's left or on the midline
    const char* right;  // its mirror image, or nothing
};

struct AtRing {
    Named ids;
    const char* ring;
    std::size_t index;
};

// Points that are points of the cage.
constexpr AtRing at_rings[]{
    {{"2.1", nullptr}, "row12", 0},
    {{"2.2", nullptr}, "mouth.contact", 0},
    {{"2.3", nullptr}, "mouth.contact", 8},
    {{"2.4", "2.5"}, "mouth.contact", 4},
    {{"2.10", nullptr}, "row11", 0},
    {{"2.11", "2.12"}, "row12", 3},
    {{"2.13", "2.14"}, "row12", 6},
    {{"3.1", "3.2"}, "eye.margin", 1},
    {{"3.3", "3.4"}, "eye.margin", 5},
    {{"3.7", "3.12"}, "eye.margin", 3},
    {{"3.9", "3.10"}, "eye.fold", 5},
    {{"3.11", "3.8"}, "eye.margin", 7},
    {{"3.13", "3.14"}, "eye.fold", 1},
    {{"4.1", "4.2"}, "row2", 2},
    {{"4.3", "4.4"}, "row2", 4},
    {{"4.5", "4.6"}, "row2", 5},
    {{"7.1", nullptr}, "row6", 11},
    {{"8.1", nullptr}, "mouth.border", 0},
    {{"8.2", nullptr}, "mouth.border", 8},
    {{"8.3", "8.4"}, "mouth.border", 4},
    {{"8.10", "8.9"}, "mouth.border", 1},
    {{"9.3", nullptr}, "row6", 0},
    {{"9.5", "9.4"}, "row8", 2},
    {{"9.7", "9.6"}, "row4", 2},
    {{"9.12", nullptr}, "row5", 0},
    {{"9.13", "9.14"}, "row5", 2},
    {{"9.15", nullptr}, "row8", 0},
    {{"10.1", "10.2"}, "ear.edge", 1},
    {{"10.3", "10.4"}, "ear.edge", 3},
    {{"10.5", "10.6"}, "ear.edge", 6},
    {{"10.7", "10.8"}, "ear.root", 7},
    {{"10.9", "10.10"}, "ear.root", 0},
};

struct Between {
    Named ids;
    const char* ring;
    std::size_t from, to;  // stretch of the ring
    std::size_t a, b;      // x lies halfway between these two of its points
};

constexpr Between halfway[]{
    {{"2.6", "2.7"}, "mouth.contact", 0, 4, 0, 4},
    {{"2.8", "2.9"}, "mouth.contact", 4, 8, 8, 4},
    {{"8.5", "8.6"}, "mouth.border", 0, 4, 0, 4},
    {{"8.7", "8.8"}, "mouth.border", 4, 8, 8, 4},
};

struct Near {
    Named ids;
    Vec3 place;
};

// Points by their place on the skin: the nearest vertex.
constexpr Near near_places[]{
    {{"5.1", "5.2"}, {46, -65.2, 77}},  {{"5.3", "5.4"}, {41, -26, 80}},  {{"9.1", "9.2"}, {16.2, -34.5, 101.5}},
    {{"11.1", nullptr}, {0, 73, 86}},   {{"11.3", "11.2"}, {48, 60, 74}}, {{"11.4", nullptr}, {0, 111, -14}},
    {{"11.6", nullptr}, {0, 0, -90.5}},
};

struct Namer {
    Head& head;
    const Skin& skin;

    void skin_point(const Named& ids, std::uint32_t vertex) {
        head.points.push_back({ids.left, skin_part, vertex});
        if (ids.right != nullptr) head.points.push_back({ids.right, skin_part, skin.mesh.mirror[vertex]});
    }

    std::uint32_t on_ring(const Between& b) const {
        const auto& ring = skin.cage.rings.at(b.ring);
        const auto& positions = skin.neutral;
        const double x = (positions[ring[b.a]].x + positions[ring[b.b]].x) / 2;
        std::uint32_t best = ring[b.from];
        for (const auto v : chain(skin.mesh, {ring.begin() + static_cast<std::ptrdiff_t>(b.from),
                                              ring.begin() + static_cast<std::ptrdiff_t>(b.to) + 1}))
            if (std::abs(positions[v].x - x) < std::abs(positions[best].x - x)) best = v;
        return best;
    }

    std::uint32_t nearest(const Near& n) const {
        const auto& positions = skin.neutral;
        std::uint32_t best = 0;
        for (std::uint32_t v = 0; v < positions.size(); ++v) {
            const bool allowed = n.ids.right != nullptr || skin.mesh.mirror[v] == v;
            if (allowed && distance(positions[v], n.place) < distance(positions[best], n.place)) best = v;
        }
        return best;
    }
};

void name_points(Head& head, const Skin& skin, const Tongue& tongue) {
    Namer namer{head, skin};
    for (const AtRing& p : at_rings) namer.skin_point(p.ids, skin.cage.rings.at(p.ring)[p.index]);
    for (const Between& p : halfway) namer.skin_point(p.ids, namer.on_ring(p));
    for (const Near& p : near_places) namer.skin_point(p.ids, namer.nearest(p));
    const HeadPoint others[]{{"3.5", left_eye, 0},
                             {"3.6", right_eye, 0},
                             {"6.1", tongue_part, tongue.tip},
                             {"6.2", tongue_part, tongue.middle},
                             {"6.3", tongue_part, tongue.left_border},
                             {"6.4", tongue_part, tongue.right_border},
                             {"9.8", upper_teeth, 1},
                             {"9.9", lower_teeth, 1},
                             {"9.10", upper_teeth, 3},
                             {"9.11", lower_teeth, 3}};
    head.points.insert(head.points.end(), std::begin(others), std::end(others));
    const auto order = [](const HeadPoint& p) {
        const auto dot = p.id.find('.');
        return std::pair{std::stoi(p.id.substr(0, dot)), std::stoi(p.id.substr(dot + 1))};
    };
    std::sort(head.points.begin(), head.points.end(),
              [&](const auto& a, const auto& b) { return order(a) < order(b); });
}

}  // namespace

Head make_head(const Character& character) {
    const Skin skin = make_skin(character);
    const Tongue tongue = make_tongue();
    const Surface eye = make_left_eye(left_eye_place(character));
    Head head{character.name,
              character.title,
              {skin.mesh.surface, eye, mirrored(eye, "eye_right"), make_upper_teeth(), make_lower_teeth(),
               tongue.surface, make_brows(character, skin), make_lashes(character, skin), make_hair(character, skin)},
              {},
              {}};
    for (const PartNumber part : {upper_teeth, lower_teeth, tongue_part})
        for (Vec3& p : head.parts[part].positions) p = swollen(character.swells, p);
    head.pictures = {{"skin", paint_skin(character, skin, hair_cover(character, skin, head.parts.back()))},
                     {"eye", paint_eye(character.iris)},
                     {"hair", paint_hair(character.hair)}};
    for (Surface& part : head.parts) round_positions(part);
    name_points(head, skin, tongue);
    return head;
}

Vec3 place(const Head& head, const HeadPoint& point) {
    return head.parts[point.part].positions[point.vertex];
}

}  // namespace mien::samples
