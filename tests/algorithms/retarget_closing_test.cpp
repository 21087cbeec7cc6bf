// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Contact on real faces: what closes on a performer closes on other people, on a cartoon, on another topology and on a
// creature. The tables of docs/methods.md.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>

#include "retarget_faces.hpp"

namespace mien {
namespace {

using faces::Frames;
using faces::Points;

struct Pair {
    const char *upper, *lower;
};
constexpr std::array<Pair, 2> lids{{{"3.1", "3.3"}, {"3.2", "3.4"}}};
constexpr std::array<Pair, 3> inner_lips{{{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}}};

struct Way {
    const char* name;
    RetargetOptions options;
};
const Way ways[] = {
    {"network, affine term", {RetargetMethod::rbf, Reading::remedied, {}, false}},
    {"units of MPEG-4", {RetargetMethod::fapu, Reading::remedied, {}, false}},
    {"one map per point", {RetargetMethod::local_affine, Reading::remedied, {}, false}},
    {"contact, units", {RetargetMethod::fapu, Reading::remedied, {}, true}},
    {"contact", {}},
};
bool keeps_contact(const Way& way) {
    return way.options.contact;
}

Vec3 between(const Take& take, std::size_t r, const Pair& pair) {
    return row(take, r)[*find_column(take, pair.upper)] - row(take, r)[*find_column(take, pair.lower)];
}

class RealFaces : public ::testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(faces::folder() / "ict"))
            GTEST_SKIP() << faces::folder() / "ict"
                         << " is not there";
        source = faces::person('a');
        const Points b = faces::person('b');
        targets = {
            {"b", b},
            {"cartoon", faces::cartoon(b)},
            {"MakeHuman", faces::from_obj("mh-caucasian/mh-caucasian-female.obj", "mh-caucasian/points-obj.json")},
            {"Suzanne", faces::from_glb("suzanne/suzi.glb", "suzanne/points.json")}};
    }
    Points source;
    std::vector<std::pair<std::string, Points>> targets;
};

// The lids meet at three heights, slipping aside; then half way there.
Frames closing_eyes(const Points& face, double share) {
    Frames frames;
    for (const double part : {1.0, 0.8, 0.5})
        for (const double slip : {-0.02, 0.0, 0.02}) {
            frames.emplace_back();
            for (const auto& [upper, lower] : lids) {
                const Vec3 opening = face.at(upper) - face.at(lower), aside{slip * faces::eyes(face), 0, 0};
                frames.back()[upper] = -share * part * opening + aside;
                frames.back()[lower] = share * (1 - part) * opening + aside;
            }
        }
    return frames;
}

// The lips as they are at rest, carried along: both points of a pair move by the pair's mean.
Frames sealed_lips() {
    Frames frames;
    const std::map<std::string, Points> shapes = faces::shapes();
    for (const char* name : {"jawOpen", "jawLeft", "mouthSmileLeft", "mouthPucker", "mouthLeft", "jawForward"}) {
        Points frame = shapes.at(name);
        for (const auto& [upper, lower] : inner_lips) {
            const Vec3 mean = 0.5 * (frame[upper] + frame[lower]);
            frame[upper] = frame[lower] = mean;
        }
        frames.push_back(frame);
    }
    return frames;
}

TEST_F(RealFaces, lids_close_and_half_close) {
    const Take shut = faces::take_of(source, closing_eyes(source, 1)),
               half = faces::take_of(source, closing_eyes(source, 0.5));
    for (const Way& way : ways) {
        std::string line = fmt::format("{:22} lid gap, half closed:", way.name);
        for (const auto& [name, target] : targets) {
            const Take closed = faces::performed(shut, target, way.options);
            const Take half_closed = faces::performed(half, target, way.options);
            double gap = 0, left = 0;
            std::size_t count = 0;
            for (std::size_t r = 1; r < row_count(closed); ++r)
                for (const Pair& pair : lids) {
                    const double found = length(between(closed, r, pair)) / faces::eyes(target);
                    gap += found;
                    const Vec3 rest = between(half_closed, 0, pair);
                    const double share = dot(between(half_closed, r, pair), rest) / dot(rest, rest);
                    left += share;
                    ++count;
                    if (!keeps_contact(way)) continue;
                    EXPECT_LE(found, 0.00051) << name;
                    EXPECT_NEAR(share, 0.5, 0.01) << name;
                }
            line += fmt::format("  {} {:.4f} {:.3f}", name, gap / static_cast<double>(count),
                                left / static_cast<double>(count));
        }
        std::cout << line << "\n";
    }
}

TEST_F(RealFaces, a_source_of_upper_lids_alone_closes_nearly) {
    Points sparse = source;
    sparse.erase("3.3");
    sparse.erase("3.4");
    const Take take = faces::take_of(sparse, {closing_eyes(source, 1)[1]});
    for (const Way& way : ways) {
        std::string line = fmt::format("{:22} lid gap, upper lids:", way.name);
        for (const auto& [name, target] : targets) {
            const Take out = faces::performed(take, target, way.options);
            double gap = 0;
            for (const auto& [upper, lower] : lids)
                gap += 0.5 * distance(row(out, 1)[*find_column(out, upper)], target.at(lower)) / faces::eyes(target);
            line += fmt::format("  {} {:.4f}", name, gap);
            if (keeps_contact(way)) {
                EXPECT_LE(gap, 0.025) << name;
            }
        }
        std::cout << line << "\n";
    }
}

TEST_F(RealFaces, sealed_lips_stay_sealed_wherever_they_are_carried) {
    const Take take = faces::take_of(source, sealed_lips());
    for (const Way& way : ways) {
        std::string line = fmt::format("{:22} sealed lips change:", way.name);
        for (const auto& [name, target] : targets) {
            const Take out = faces::performed(take, target, way.options);
            double change = 0;
            for (std::size_t r = 1; r < row_count(out); ++r)
                for (const Pair& pair : inner_lips)
                    change = std::max(
                        change, std::abs(between(out, r, pair).y - between(out, 0, pair).y) / faces::eyes(target));
            line += fmt::format("  {} {:.4f}", name, change);
            if (keeps_contact(way)) {
                EXPECT_LE(change, 0.001) << name;
            }
        }
        std::cout << line << "\n";
    }
}

// The deepest way of a kind of pair below its own rest or zero, along the direction in which it opens.
double deepest(const Retarget& map, const Take& out, bool of_lids, double eyes) {
    double depth = 0;
    for (const ContactPair& pair : map.pairs) {
        if ((pair.kind == ContactPair::Kind::lids) != of_lids) continue;
        const double floor = std::min(0.0, pair.target_opening);
        for (std::size_t r = 1; r < row_count(out); ++r)
            depth =
                std::max(depth, floor - dot(row(out, r)[pair.upper] - row(out, r)[pair.lower], pair.target_up) / eyes);
    }
    return depth;
}

// Many shapes at once: lips and lids of the source cross in some of the rows.
TEST_F(RealFaces, nothing_crosses) {
    const Take take = faces::take_of(source, faces::mixes(faces::open_shapes(), 400));
    for (const Way& way : ways) {
        std::string line = fmt::format("{:22} deepest crossing of lids, lips:", way.name);
        for (const auto& [name, target] : targets) {
            const Take out = faces::performed(take, target, way.options);
            const Retarget directions = fit_retarget(take, faces::face_of(target));
            const double lid = deepest(directions, out, true, faces::eyes(target));
            const double lip = deepest(directions, out, false, faces::eyes(target));
            line += fmt::format("  {} {:.4f} {:.4f}", name, lid, lip);
            if (keeps_contact(way)) {
                EXPECT_LE(lid, 1e-9) << name;
                EXPECT_LE(lip, 0.00051) << name;
            }
        }
        std::cout << line << "\n";
    }
}

TEST_F(RealFaces, rest_maps_to_rest) {
    const Take take = faces::take_of(source, {Points{}});
    for (const Way& way : ways)
        for (const auto& [name, target] : targets) {
            const Take out = faces::performed(take, target, way.options);
            for (std::size_t c = 0; c < out.points.size(); ++c)
                EXPECT_LT(distance(row(out, 1)[c], target.at(out.points[c])), 1e-9) << way.name << name;
        }
}

// Every shape together with its mirror partner: what is left of the right side after the left, mirrored, is taken away.
TEST_F(RealFaces, an_expression_alike_on_both_sides_stays_so) {
    std::map<std::string, Points> shapes = faces::open_shapes();
    Frames frames;
    for (const auto& [name, motion] : shapes) {
        Points both = motion;
        for (const auto& [id, d] : motion) {
            const std::string other(mirror_point(id));
            if (!other.empty()) both[other] += Vec3{-d.x, d.y, d.z};
        }
        frames.push_back(both);
    }
    const Take take = faces::take_of(source, frames);
    for (const Way& way : ways) {
        std::string line = fmt::format("{:22} asymmetry:", way.name);
        for (const auto& [name, target] : targets) {
            if (name == "Suzanne") continue;
            const Take out = faces::performed(take, target, way.options);
            double odd = 0, all = 0;
            for (std::size_t r = 1; r < row_count(out); ++r)
                for (std::size_t c = 0; c < out.points.size(); ++c) {
                    const auto m = find_column(out, mirror_point(out.points[c]));
                    if (!m) continue;
                    const Vec3 d = row(out, r)[c] - row(out, 0)[c], e = row(out, r)[*m] - row(out, 0)[*m];
                    const Vec3 miss = 0.5 * (d - Vec3{-e.x, e.y, e.z});
                    odd += dot(miss, miss);
                    all += dot(d, d);
                }
            line += fmt::format("  {} {:.4f}", name, std::sqrt(odd / all));
            if (keeps_contact(way)) {
                EXPECT_LE(std::sqrt(odd / all), 0.025) << name;
            }
        }
        std::cout << line << "\n";
    }
}

// Noise of 0.002 eye distances on the source at rest; then how much rougher in time a recording becomes.
TEST_F(RealFaces, noise_and_roughness_pass_as_they_are) {
    Frames noise(300);
    faces::Dice dice;
    for (Points& frame : noise)
        for (const auto& [id, p] : source)
            frame[id] = 0.002 * faces::eyes(source) * Vec3{dice.normal(), dice.normal(), dice.normal()};
    const Take noisy = faces::take_of(source, noise),
               played = faces::take_of(source, faces::recording("jm-slate3.csv"));
    const auto roughness = [](const Take& take) {
        double second = 0, motion = 0;
        for (std::size_t r = 2; r + 1 < row_count(take); ++r)
            for (std::size_t c = 0; c < take.points.size(); ++c) {
                const Vec3 a = row(take, r - 1)[c], b = row(take, r)[c], d = row(take, r + 1)[c],
                           m = b - row(take, 0)[c];
                second += dot(a - 2.0 * b + d, a - 2.0 * b + d);
                motion += dot(m, m);
            }
        return std::sqrt(second / motion);
    };
    for (const Way& way : ways) {
        std::string line = fmt::format("{:22} noise gain mean, worst, roughness:", way.name);
        for (const auto& [name, target] : targets) {
            const Take out = faces::performed(noisy, target, way.options);
            const Take in = [&, &wanted = target] {
                Points shared;
                for (const auto& [id, p] : source)
                    if (wanted.contains(id)) shared[id] = p;
                return faces::take_of(shared, faces::recording("jm-slate3.csv"));
            }();
            double all = 0, worst = 0;
            for (std::size_t c = 0; c < out.points.size(); ++c) {
                const std::size_t s = *find_column(noisy, out.points[c]);
                double energy = 0, given = 0;
                for (std::size_t r = 1; r < row_count(out); ++r) {
                    const Vec3 d = row(out, r)[c] - row(out, 0)[c], e = row(noisy, r)[s] - row(noisy, 0)[s];
                    energy += dot(d, d);
                    given += dot(e, e);
                }
                const double gain = std::sqrt(energy / given) * faces::eyes(source) / faces::eyes(target);
                all += gain * gain;
                worst = std::max(worst, gain);
            }
            const double mean = std::sqrt(all / static_cast<double>(out.points.size()));
            const double rougher = roughness(faces::performed(played, target, way.options)) / roughness(in);
            line += fmt::format("  {} {:.2f} {:.2f} {:.2f}", name, mean, worst, rougher);
            if (keeps_contact(way) && name == "b") {
                EXPECT_LE(mean, 1.1);
                EXPECT_LE(worst, 1.4);
                EXPECT_LE(rougher, 1.05);
            }
        }
        std::cout << line << "\n";
    }
}

TEST_F(RealFaces, there_and_back_is_where_it_began) {
    const Points& other = targets[2].second;
    const Take take = faces::take_of(source, faces::mixes(faces::open_shapes()));
    for (const Way& way : ways) {
        const Take there = faces::performed(take, other, way.options);
        Points shared;
        for (const std::string& id : there.points) shared[id] = source.at(id);
        const Take back = faces::performed(there, shared, way.options);
        const double error = faces::relative_error(back, faces::take_of(shared, faces::mixes(faces::open_shapes())));
        std::cout << fmt::format("{:22} to MakeHuman and back: {:.3f}\n", way.name, error);
    }
}

}  // namespace
}  // namespace mien
