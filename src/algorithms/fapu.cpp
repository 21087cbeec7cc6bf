// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Face animation parameter units, ISO/IEC 14496-2, Annex C: distances between feature points of the neutral face. Each
// is tried from the points that the standard names, then from others that lie near them.

#include "mien/algorithms/fapu.hpp"

#include <array>
#include <fmt/format.h>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "algorithms/eyeballs.hpp"
#include "algorithms/island.hpp"
#include "algorithms/small_mouth.hpp"

#include "mien/algorithms/weld.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

// Shares of the eye separation.
constexpr double iris_share = 0.17, eyes_to_nose_share = 0.79, nose_to_mouth_share = 0.33, mouth_width_share = 0.82;
constexpr double eyeball_share = 0.19;  // radius: 12 mm of 63 mm
constexpr double least_share = 0.001;   // less is no distance but noise

using Ids = std::array<std::string_view, 2>;  // the second may be empty

std::string listed(const Ids& ids) {
    return std::string(ids[0]) + (ids[1].empty() ? "" : " and ") + std::string(ids[1]);
}

// The mean of the points, when all are there.
std::optional<Vec3> middle(std::span<const FeaturePoint> points, const Ids& ids) {
    const auto first = find_point(points, ids[0]);
    const auto second = ids[1].empty() ? first : find_point(points, ids[1]);
    if (!first || !second) return std::nullopt;
    return 0.5 * (points[*first].position + points[*second].position);
}

struct Eyes {
    Vec3 left, right;
};

class Measurer {
public:
    explicit Measurer(std::span<const FeaturePoint> points) : points_(points) {
        fapu_.points.assign(points.begin(), points.end());
    }

    Fapu measure() {
        const Eyes eyes = find_eyes();
        const double eye_height = 0.5 * (eyes.left.y + eyes.right.y);
        fapu_.irisd = iris(fapu_.es);
        const double nose = nose_height(eye_height);
        fapu_.ens = eye_height - nose;
        fapu_.mns = nose - mouth_height(nose);
        fapu_.mw = mouth_width();
        const Vec3 inwards{0, 0, -eyeball_share * fapu_.es};
        fapu_.left_eye = eyes.left + inwards;
        fapu_.right_eye = eyes.right + inwards;
        fapu_.neck = neck(0.5 * (eyes.left + eyes.right));
        return std::move(fapu_);
    }

private:
    void note(std::string_view what, std::string_view missing, const std::string& taken,
              std::initializer_list<FapUnit> units) {
        fapu_.uncertain.insert(fapu_.uncertain.end(), units);
        fapu_.estimated.push_back(fmt::format("{}: {}; taken from {}", what, missing, taken));
    }

    Eyes find_eyes() {
        struct Pair {
            Ids left, right;
        };
        constexpr std::array<Pair, 6> pairs{{{{"3.5"}, {"3.6"}},
                                             {{"3.7", "3.11"}, {"3.8", "3.12"}},
                                             {{"3.1", "3.3"}, {"3.2", "3.4"}},
                                             {{"3.9", "3.13"}, {"3.10", "3.14"}},
                                             {{"3.1"}, {"3.2"}},
                                             {{"3.3"}, {"3.4"}}}};
        for (const Pair& pair : pairs) {
            const auto left = middle(points_, pair.left), right = middle(points_, pair.right);
            if (!left || !right) continue;
            if (&pair != pairs.data())
                note("ES", "3.5 or 3.6 is missing", fmt::format("{}, and {}", listed(pair.left), listed(pair.right)),
                     {});
            if (&pair > pairs.data() + 1) fapu_.uncertain.push_back(FapUnit::es);
            fapu_.es = left->x - right->x;
            if (fapu_.es > least_share * distance(*left, *right)) return {*left, *right};
            throw Error(
                fmt::format("units of the face: expected the left eye ({}) at larger x than the right one ({}), "
                            "found {} and {}; the face has to look along +z, +y up",
                            listed(pair.left), listed(pair.right), left->x, right->x));
        }
        return eyes_without_points();
    }

    // The eyes lie above the middle of the points; only their distance matters for what is measured from it.
    Eyes eyes_without_points() {
        fapu_.es = eye_distance(points_);
        if (!(fapu_.es > 0)) throw Error("units of the face: expected points that tell how large it is, found too few");
        note("ES", "no point of the eyes is there", "the spread of all points", {FapUnit::es});
        Vec3 centre;
        for (const FeaturePoint& point : points_) centre += point.position / static_cast<double>(points_.size());
        const Vec3 aside{0.5 * fapu_.es, 0, 0}, up{0, 0.5 * fapu_.es, 0};
        return {centre + up + aside, centre + up - aside};
    }

    double iris(double es) {
        double sum = 0;
        int count = 0;
        for (const auto& [upper, lower] : {std::pair("3.1", "3.3"), std::pair("3.2", "3.4")}) {
            const auto a = middle(points_, {upper}), b = middle(points_, {lower});
            if (!a || !b) continue;
            sum += a->y - b->y;
            ++count;
        }
        if (count > 0 && sum / count > least_share * es) return sum / count;
        note("IRISD", count > 0 ? "the lids touch" : "neither eye has both lids (3.1 and 3.3, 3.2 and 3.4)",
             fmt::format("{} of ES", iris_share), {FapUnit::irisd});
        return iris_share * es;
    }

    // 9.15.y, below the eyes.
    double nose_height(double eye_height) {
        struct Choice {
            Ids ids;
            double above;  // of the bottom of the nose, as a share of ES
        };
        constexpr std::array<Choice, 4> choices{
            {{{"9.15"}, 0}, {{"9.4", "9.5"}, 0.03}, {{"9.1", "9.2"}, 0.17}, {{"9.3"}, 0.25}}};
        for (const Choice& choice : choices) {
            const auto point = middle(points_, choice.ids);
            if (!point) continue;
            const double height = point->y - choice.above * fapu_.es;
            if (!(eye_height - height > least_share * fapu_.es)) continue;
            if (&choice != choices.data())
                note("ENS and MNS", "9.15 is missing or above the eyes", listed(choice.ids),
                     {FapUnit::ens, FapUnit::mns});
            return height;
        }
        note("ENS and MNS", "no point of the nose is there below the eyes", fmt::format("{} of ES", eyes_to_nose_share),
             {FapUnit::ens, FapUnit::mns});
        return eye_height - eyes_to_nose_share * fapu_.es;
    }

    // 2.2.y, below the nose: with closed lips, where they meet.
    double mouth_height(double nose) {
        constexpr std::array<Ids, 4> choices{{{"2.2"}, {"2.4", "2.5"}, {"8.3", "8.4"}, {"8.1", "8.2"}}};
        for (const Ids& choice : choices) {
            const auto point = middle(points_, choice);
            if (!point || !(nose - point->y > least_share * fapu_.es)) continue;
            if (&choice != choices.data())
                note("MNS", "2.2 is missing or above the nose", listed(choice), {FapUnit::mns});
            return point->y;
        }
        note("MNS", "no point of the lips is there below the nose", fmt::format("{} of ES", nose_to_mouth_share),
             {FapUnit::mns});
        return nose - nose_to_mouth_share * fapu_.es;
    }

    double mouth_width() {
        const auto width = [&](std::string_view left, std::string_view right) {
            const auto a = middle(points_, {left}), b = middle(points_, {right});
            return a && b ? a->x - b->x : 0;
        };
        if (const double outer = width("8.3", "8.4"); outer > least_share * fapu_.es) return outer;
        if (const double inner = width("2.4", "2.5"); inner > least_share * fapu_.es) {
            note("MW", "8.3 or 8.4 is missing", "2.4 and 2.5, widened by an eighth", {FapUnit::mw});
            return 1.125 * inner;
        }
        note("MW", "the corners of the mouth are missing", fmt::format("{} of ES", mouth_width_share), {FapUnit::mw});
        return mouth_width_share * fapu_.es;
    }

    // Without a point for it the head turns where the skull sits on the spine: between and below the ears.
    Vec3 neck(const Vec3& between_eyes) {
        if (const auto point = middle(points_, {"7.1"})) return *point;
        for (const Ids& ears : {Ids{"10.5", "10.6"}, Ids{"10.7", "10.8"}, Ids{"10.3", "10.4"}})
            if (const auto point = middle(points_, ears)) {
                note("centre of head turns", "7.1 is missing", listed(ears), {});
                return *point;
            }
        note("centre of head turns", "7.1 is missing", "the eyes, 0.8 of ES below and 1.5 of ES behind them", {});
        return between_eyes + Vec3{0, -0.8 * fapu_.es, -1.5 * fapu_.es};
    }

    std::span<const FeaturePoint> points_;
    Fapu fapu_;
};

}  // namespace

Fapu measure_fapu(std::span<const FeaturePoint> neutral) {
    return Measurer(neutral).measure();
}

Fapu measure_fapu(const Face& face) {
    Fapu fapu = measure_fapu(std::span(face.points));
    if (vertex_count(face.mesh) == 0) return fapu;
    const Weld welded = weld(face.mesh);
    const std::vector<Island> list = list_islands(face, welded);
    for (const EyeballIslands& eyeball : find_eyeballs(face, welded, list)) {
        const Vec3& centre = eyeball.ball.centre;
        Vec3& estimate =
            distance(centre, fapu.left_eye) < distance(centre, fapu.right_eye) ? fapu.left_eye : fapu.right_eye;
        if (centre.z < estimate.z + eyeball_share * fapu.es) estimate = centre;  // behind the pupil
    }
    return fapu;
}

Fapu restrained(Fapu fapu) {
    fapu.mns *= mouth_share(fapu.mw / mouth_width_share, fapu.mns / nose_to_mouth_share);
    return fapu;
}

std::vector<FeaturePoint> points_of_row(const Take& take, std::size_t number) {
    if (number >= row_count(take))
        throw Error(fmt::format("points of a take: expected a row below {}, found {}", row_count(take), number));
    std::vector<FeaturePoint> points;
    for (std::size_t c = 0; c < take.points.size(); ++c)
        if (const Vec3& p = row(take, number)[c]; is_finite(p)) points.push_back({take.points[c], 0, p, {}, 0});
    return points;
}

std::vector<FeaturePoint> neutral_points(const Take& take, const NeutralOptions& options) {
    const std::vector<Vec3> positions = neutral(take, options);
    std::vector<FeaturePoint> points;
    for (std::size_t c = 0; c < positions.size(); ++c)
        if (is_finite(positions[c])) points.push_back({take.points[c], 0, positions[c], {}, 0});
    return points;
}

}  // namespace mien
