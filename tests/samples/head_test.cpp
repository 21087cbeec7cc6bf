// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The sample head: what its topology, sizes and feature points must be, computed from the generator's own result.

#include "head.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>

#include "eyeball.hpp"
#include "skin.hpp"

namespace mien::samples {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

const std::vector<Head>& heads() {
    static const std::vector<Head> made = [] {
        std::vector<Head> all;
        for (const Character& character : cast()) all.push_back(make_head(character));
        return all;
    }();
    return made;
}

// The first of the cast; the laws of form hold for all of them.
const Head& head() {
    return heads().front();
}

const Surface& skin_of(const Head& a) {
    return a.parts.front();
}

const Surface& skin() {
    return skin_of(head());
}

const Skin& made_skin() {
    static const Skin made = make_skin(cast().front());
    return made;
}

// Directed edges with the number of faces that run along them.
std::map<Edge, int> directed_edges(const Surface& surface) {
    std::map<Edge, int> edges;
    for (const SurfaceFace& face : surface.faces)
        for (std::size_t k = 0, n = corner_count(face); k < n; ++k)
            ++edges[{face.corners[k], face.corners[(k + 1) % n]}];
    return edges;
}

std::map<std::uint32_t, std::set<std::uint32_t>> neighbours(const std::map<Edge, int>& edges) {
    std::map<std::uint32_t, std::set<std::uint32_t>> result;
    for (const auto& [edge, count] : edges) {
        result[edge.first].insert(edge.second);
        result[edge.second].insert(edge.first);
    }
    return result;
}

std::map<Edge, int> border_edges(const Surface& surface) {
    const auto edges = directed_edges(surface);
    std::map<Edge, int> border;
    for (const auto& [edge, count] : edges)
        if (!edges.contains({edge.second, edge.first})) border.emplace(edge, count);
    return border;
}

// Sets of vertices that hang together over the given edges.
std::vector<std::set<std::uint32_t>> pieces(const std::map<Edge, int>& edges) {
    auto around = neighbours(edges);
    std::vector<std::set<std::uint32_t>> result;
    while (!around.empty()) {
        std::set<std::uint32_t> piece;
        std::vector<std::uint32_t> open{around.begin()->first};
        while (!open.empty()) {
            const std::uint32_t v = open.back();
            open.pop_back();
            if (!piece.insert(v).second) continue;
            open.insert(open.end(), around.at(v).begin(), around.at(v).end());
        }
        for (const auto v : piece) around.erase(v);
        result.push_back(piece);
    }
    return result;
}

Vec3 point(const Head& a, const std::string& id) {
    const auto found = std::find_if(a.points.begin(), a.points.end(), [&](const auto& p) { return p.id == id; });
    if (found == a.points.end()) throw std::out_of_range(id);
    return place(a, *found);
}

Vec3 point(const std::string& id) {
    return point(head(), id);
}

std::uint32_t skin_vertex(const std::string& id) {
    return std::find_if(head().points.begin(), head().points.end(), [&](const auto& p) { return p.id == id; })->vertex;
}

double along_edges(const Surface& surface, std::uint32_t from, std::uint32_t to) {
    const auto around = neighbours(directed_edges(surface));
    std::vector<double> reached(surface.positions.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.push({reached[from] = 0, from});
    while (!open.empty()) {
        const auto [d, v] = open.top();
        open.pop();
        if (d > reached[v]) continue;
        for (const auto n : around.at(v)) {
            const double next = d + distance(surface.positions[v], surface.positions[n]);
            if (next < reached[n]) open.push({reached[n] = next, n});
        }
    }
    return reached[to];
}

std::vector<std::array<Vec3, 3>> triangles(const Surface& surface) {
    std::vector<std::array<Vec3, 3>> result;
    for (const SurfaceFace& face : surface.faces)
        for (std::size_t k = 1; k + 1 < corner_count(face); ++k)
            result.push_back({surface.positions[face.corners[0]], surface.positions[face.corners[k]],
                              surface.positions[face.corners[k + 1]]});
    return result;
}

double volume(const Surface& surface) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles(surface)) sum += dot(a, cross(b, c)) / 6;
    return sum;
}

// How often the surface winds round a point: the solid angle it covers seen from there over that of the full sphere.
double winding(const std::vector<std::array<Vec3, 3>>& surface, const Vec3& p) {
    double sum = 0;
    for (const auto& t : surface) {
        const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

double width(const std::string& a, const std::string& b) {
    return distance(point(a), point(b));
}

TEST(SampleHead, SkinEyesAndMouthHaveBetweenFourAndTenThousandVertices) {
    for (const Head& a : heads()) {
        std::size_t count = 0, all = 0;
        for (std::size_t part = 0; part < a.parts.size(); ++part) {
            all += a.parts[part].positions.size();
            if (part < 6) count += a.parts[part].positions.size();
        }
        EXPECT_GE(count, 4000U) << a.name;
        EXPECT_LE(count, 10000U) << a.name;
        EXPECT_LE(all, 15000U) << a.name;
    }
}

TEST(SampleHead, HasEyesTeethTongueBrowsLashesAndHairAsPartsOfTheirOwn) {
    std::vector<std::string> names;
    for (const Surface& part : head().parts) names.push_back(part.name);
    EXPECT_EQ(names, (std::vector<std::string>{"head", "eye_left", "eye_right", "teeth_upper", "teeth_lower", "tongue",
                                               "eyebrows", "eyelashes", "hair"}));
}

TEST(SampleHead, EveryPictureThatAMaterialNamesIsThere) {
    for (const Head& a : heads()) {
        std::set<std::string> pictures, materials;
        for (const NamedPicture& p : a.pictures) {
            pictures.insert(p.name);
            EXPECT_EQ(p.picture.rgba.size(), 4U * p.picture.width * p.picture.height) << p.name;
        }
        for (const Surface& part : a.parts)
            for (const Material& m : part.materials) {
                materials.insert(m.name);
                EXPECT_TRUE(m.picture.empty() || pictures.contains(m.picture)) << m.picture;
            }
        EXPECT_EQ(materials,
                  (std::set<std::string>{"skin", "eye", "cornea", "teeth", "gums", "tongue", "brow", "lash", "hair"}));
    }
}

TEST(SampleHead, NoEdgeHasMoreThanTwoFacesAndNeighboursWindAlike) {
    for (const Head& a : heads())
        for (const Surface& part : a.parts)
            for (const auto& [edge, count] : directed_edges(part)) ASSERT_EQ(count, 1) << a.name << ' ' << part.name;
}

TEST(SampleHead, EveryVertexIsUsed) {
    for (const Surface& part : head().parts) EXPECT_EQ(neighbours(directed_edges(part)).size(), part.positions.size());
}

TEST(SampleHead, SkinIsOnePieceOpenAtTheEyesAndTheNeckOnly) {
    EXPECT_EQ(pieces(directed_edges(skin())).size(), 1U);
    int left = 0, right = 0, neck = 0;
    const auto openings = pieces(border_edges(skin()));
    for (const auto& opening : openings) {
        Vec3 middle;
        for (const auto v : opening) middle += skin().positions[v] / static_cast<double>(opening.size());
        left += distance(middle, left_eye_centre) < 5 && opening.size() == 32;
        right += distance({-middle.x, middle.y, middle.z}, left_eye_centre) < 5 && opening.size() == 32;
        neck += middle.y < -150;
    }
    EXPECT_EQ(openings.size(), 3U);
    EXPECT_EQ(left + right + neck, 3);
    EXPECT_EQ(neck, 1);
}

TEST(SampleHead, TeethAndTongueAreClosed) {
    for (std::size_t part = 3; part < 6; ++part) EXPECT_TRUE(border_edges(head().parts[part]).empty());
}

TEST(SampleHead, SkinIsMadeOfQuadsThatAreNotFolded) {
    for (const Head& a : heads())
        for (const SurfaceFace& face : skin_of(a).faces) {
            ASSERT_EQ(corner_count(face), 4U);
            const auto at = [&](std::size_t k) { return skin_of(a).positions[face.corners[k % 4]]; };
            const Vec3 normal = cross(at(2) - at(0), at(3) - at(1));
            for (std::size_t k = 0; k < 4; ++k)
                EXPECT_GT(dot(normal, cross(at(k + 1) - at(k), at(k + 3) - at(k))), 0)
                    << a.name << ' ' << at(0).x << ' ' << at(0).y << ' ' << at(0).z;
        }
}

TEST(SampleHead, FacesLookOutwards) {
    for (const Head& a : heads())
        for (const std::size_t part : {0U, 1U, 2U, 3U, 4U, 5U, 8U})
            EXPECT_GT(volume(a.parts[part]), 0) << a.name << ' ' << a.parts[part].name;
    // A head without its neck holds about four litres.
    EXPECT_NEAR(volume(skin()), 4e6, 0.8e6);
}

TEST(SampleHead, SkinIsItsOwnMirrorImage) {
    const MirroredSurface& mesh = made_skin().mesh;
    std::set<std::set<std::uint32_t>> faces;
    for (const SurfaceFace& face : skin().faces) faces.emplace(face.corners.begin(), face.corners.end());
    for (std::uint32_t v = 0; v < mesh.mirror.size(); ++v) {
        const Vec3 p = skin().positions[v];
        ASSERT_EQ(skin().positions[mesh.mirror[v]], (Vec3{-p.x, p.y, p.z}));
    }
    for (const SurfaceFace& face : skin().faces) {
        std::set<std::uint32_t> image;
        for (const auto c : face.corners) image.insert(mesh.mirror[c]);
        ASSERT_TRUE(faces.contains(image));
    }
}

TEST(SampleHead, NoTwoVerticesShareAPlace) {
    for (const std::size_t part : {0U, 3U, 4U, 5U}) {
        const Surface& surface = head().parts[part];
        std::set<std::array<double, 3>> places;
        for (const Vec3& p : surface.positions) places.insert({p.x, p.y, p.z});
        EXPECT_EQ(places.size(), surface.positions.size()) << surface.name;
    }
}

TEST(SampleHead, LipsTouchInSpaceButNotAlongTheSurface) {
    for (const auto& [upper, lower] : {std::pair{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}}) {
        for (const Head& a : heads()) {
            const double gap = distance(point(a, upper), point(a, lower));
            EXPECT_LE(gap, 0.25) << a.name;
            // Readers that join vertices within a ten thousandth of the height must not join the lips.
            EXPECT_GT(gap, 3 * 1e-4 * 290) << a.name;
        }
        EXPECT_GT(along_edges(skin(), skin_vertex(upper), skin_vertex(lower)), 20);
    }
    const double round_the_corner = along_edges(skin(), skin_vertex("2.2"), skin_vertex("2.3"));
    EXPECT_GT(round_the_corner, 0.9 * width("2.4", "2.5"));
}

TEST(SampleHead, EyeballsStayBehindTheLids) {
    for (std::size_t i = 0; i < heads().size(); ++i) {
        const EyePlace eye = left_eye_place(cast()[i]);
        const Surface& skin = skin_of(heads()[i]);
        const auto clear = [&](const Vec3& p) {
            const Vec3 d = p - eye.centre;
            return length(d) - eye.scale * eye_reach(std::acos(d.z / length(d)));
        };
        double least = 1e9;
        for (const SurfaceFace& face : skin.faces) {
            Vec3 middle;
            for (const auto c : face.corners) {
                middle += skin.positions[c] / 4.0;
                least = std::min(least, clear(skin.positions[c]));
            }
            least = std::min(least, clear(middle));
        }
        EXPECT_GT(least, 0) << heads()[i].name;
        EXPECT_LT(least, 0.5) << heads()[i].name;
    }
}

// The hair line lies in the skin, all else of the cap over it; a lash starts at the edge of a lid.
TEST(SampleHead, HairBrowsAndLashesStandOnTheSkin) {
    for (const Head& a : heads()) {
        const auto gap = [&](const Vec3& p) {
            double least = 1e9;
            for (const Vec3& q : skin_of(a).positions) least = std::min(least, distance(p, q));
            return least;
        };
        for (const std::size_t part : {6U, 7U}) {
            double far = 0;
            for (const Vec3& p : a.parts[part].positions) far = std::max(far, gap(p));
            EXPECT_LT(far, 12) << a.name << ' ' << a.parts[part].name;
        }
        const auto inside = triangles(skin_of(a));
        const auto& cap = a.parts[8].positions;
        std::size_t sunk = 0;
        for (std::size_t v = 0; v < cap.size(); v += 7) sunk += winding(inside, cap[v]) > .5;
        EXPECT_LT(static_cast<double>(sunk), .25 * static_cast<double>(cap.size()) / 7) << a.name;
    }
}

TEST(SampleHead, TeethAndTongueLieInTheInnerMouth) {
    EXPECT_NEAR(winding(triangles(skin()), {0, -100, 60}), 1, 0.2) << "flesh of the chin";
    for (const Head& a : heads()) {
        const auto surface = triangles(skin_of(a));
        for (std::size_t part = 3; part < 6; ++part)
            for (const Vec3& p : a.parts[part].positions) {
                EXPECT_LT(winding(surface, p), 0.5)
                    << a.name << ' ' << a.parts[part].name << ' ' << p.x << ' ' << p.y << ' ' << p.z;
                ASSERT_LT(p.z, point(a, "2.2").z);
            }
    }
}

TEST(SampleHead, TextureCoordinatesFitTheSquareAndDoNotOverlapInFront) {
    constexpr int size = 512;
    std::map<std::pair<int, int>, int> covered;
    for (const SurfaceFace& face : skin().faces) {
        const auto at = [&](std::size_t k) { return skin().positions[face.corners[k]]; };
        for (const Uv& uv : face.uvs) ASSERT_TRUE(uv.u >= 0 && uv.u <= 1 && uv.v >= 0 && uv.v <= 1);
        const Vec3 normal = cross(at(2) - at(0), at(3) - at(1));
        if (normal.z < 0.2 * length(normal)) continue;
        for (std::size_t k = 1; k < 3; ++k) {
            const Uv &a = face.uvs[0], &b = face.uvs[k], &c = face.uvs[k + 1];
            const double area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
            const auto [u0, u1] = std::minmax({a.u, b.u, c.u});
            const auto [v0, v1] = std::minmax({a.v, b.v, c.v});
            for (int j = static_cast<int>(v0 * size); j <= static_cast<int>(v1 * size) && j < size; ++j)
                for (int i = static_cast<int>(u0 * size); i <= static_cast<int>(u1 * size) && i < size; ++i) {
                    const double u = (i + .5013) / size, v = (j + .5017) / size;
                    const double s = ((u - a.u) * (c.v - a.v) - (c.u - a.u) * (v - a.v)) / area;
                    const double t = ((b.u - a.u) * (v - a.v) - (u - a.u) * (b.v - a.v)) / area;
                    if (s > 0 && t > 0 && s + t < 1) ++covered[{i, j}];
                }
        }
    }
    EXPECT_GT(covered.size(), 10000U);
    for (const auto& [place, count] : covered) ASSERT_EQ(count, 1) << place.first << ' ' << place.second;
}

TEST(SampleHead, HasAllFeaturePointsOfMpeg4ButTheHair) {
    constexpr std::array<int, 10> group_sizes{14, 14, 6, 4, 4, 1, 10, 15, 10, 6};
    std::set<std::string> expected, found;
    for (std::size_t g = 0; g < group_sizes.size(); ++g)
        for (int i = 1; i <= group_sizes[g]; ++i) expected.insert(std::to_string(g + 2) + "." + std::to_string(i));
    expected.erase("11.5");
    std::set<std::pair<std::size_t, std::uint32_t>> places;
    for (const HeadPoint& p : head().points) {
        found.insert(p.id);
        places.insert({p.part, p.vertex});
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(head().points.size(), 83U);
    EXPECT_EQ(places.size(), 83U) << "two points on one vertex";
}

// Left and right points of the standard; the left ones lie at +x.
constexpr std::array<std::array<const char*, 2>, 32> pairs{
    {{"2.4", "2.5"},    {"2.6", "2.7"},   {"2.8", "2.9"},   {"2.11", "2.12"}, {"2.13", "2.14"}, {"3.1", "3.2"},
     {"3.3", "3.4"},    {"3.5", "3.6"},   {"3.7", "3.12"},  {"3.9", "3.10"},  {"3.11", "3.8"},  {"3.13", "3.14"},
     {"4.1", "4.2"},    {"4.3", "4.4"},   {"4.5", "4.6"},   {"5.1", "5.2"},   {"5.3", "5.4"},   {"6.3", "6.4"},
     {"8.3", "8.4"},    {"8.5", "8.6"},   {"8.7", "8.8"},   {"8.10", "8.9"},  {"9.1", "9.2"},   {"9.5", "9.4"},
     {"9.7", "9.6"},    {"9.13", "9.14"}, {"10.1", "10.2"}, {"10.3", "10.4"}, {"10.5", "10.6"}, {"10.7", "10.8"},
     {"10.9", "10.10"}, {"11.3", "11.2"}}};

TEST(SampleHead, FeaturePointsLieOnTheSubjectsOwnSide) {
    std::set<std::string> middle;
    for (const HeadPoint& p : head().points) middle.insert(p.id);
    for (const auto& [left, right] : pairs) {
        const Vec3 p = point(left);
        EXPECT_GT(p.x, 1) << left;
        EXPECT_EQ(point(right), (Vec3{-p.x, p.y, p.z})) << right;
        middle.erase(left);
        middle.erase(right);
    }
    for (const std::string& id : middle) EXPECT_EQ(point(id).x, 0) << id;
}

TEST(SampleHead, FeaturePointsKeepTheStandardsConstraints) {
    constexpr double spacing = 2.5;  // half of the widest vertex spacing on the face, millimetres
    EXPECT_NEAR(point("2.6").x, (point("2.2").x + point("2.4").x) / 2, spacing);
    EXPECT_NEAR(point("2.8").x, (point("2.3").x + point("2.4").x) / 2, spacing);
    EXPECT_NEAR(point("3.1").x, (point("3.7").x + point("3.11").x) / 2, spacing);
    EXPECT_NEAR(point("3.9").x, (point("3.7").x + point("3.11").x) / 2, spacing);
    EXPECT_NEAR(point("5.1").y, point("8.3").y, spacing);
    EXPECT_NEAR(point("6.3").z, point("6.2").z, 1e-9);
    EXPECT_NEAR(point("8.5").x, (point("8.3").x + point("8.1").x) / 2, spacing);
    EXPECT_NEAR(point("9.13").y, (point("9.6").y + point("9.3").y) / 2, spacing);
    EXPECT_NEAR(point("11.6").y, point("3.5").y, 8);
    EXPECT_LT(point("8.7").x, point("2.11").x);
    EXPECT_LT(point("2.11").x, point("8.3").x);
    EXPECT_GT(point("11.3").x, point("4.3").x);
}

// L. G. Farkas (ed.), Anthropometry of the Head and Face, 2nd ed. 1994: means between women and men, millimetres. They
// hold for the neutral form, of which the cast is made.
TEST(SampleHead, NeutralFormFollowsPublishedAnthropometry) {
    const std::vector<Vec3>& neutral = made_skin().neutral;
    const auto width = [&](const char* a, const char* b) {
        return distance(neutral[skin_vertex(a)], neutral[skin_vertex(b)]);
    };
    double breadth = 0, front = 0, back = 0;
    for (const Vec3& p : neutral) {
        if (p.y > 35) breadth = std::max(breadth, 2 * p.x);
        if (p.y > 15) front = std::max(front, p.z), back = std::min(back, p.z);
    }
    EXPECT_NEAR(breadth, 151, 3) << "eu-eu";
    EXPECT_NEAR(front - back, 190, 3) << "g-op";
    EXPECT_NEAR(width("3.11", "3.8"), 32, 1.5) << "en-en";
    EXPECT_NEAR(width("3.7", "3.12"), 89, 1.5) << "ex-ex";
    EXPECT_NEAR(width("8.3", "8.4"), 51, 1.5) << "ch-ch";
    EXPECT_NEAR(width("9.1", "9.2"), 33, 2.5) << "al-al";
    EXPECT_NEAR(width("10.1", "10.5"), 61, 2.5) << "sa-sba";
    EXPECT_NEAR(width("2.13", "2.14"), 101, 5) << "go-go";
}

}  // namespace
}  // namespace mien::samples
