// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Between the motion of points and face animation parameters. No clause was found that fixes the order of turns; here
// R = Ry(yaw) Rx(pitch) Rz(roll) for the head, Ry(yaw) Rx(pitch) for the eyes, all right-handed: with the signs of the
// standard's table that is yaw to the left, pitch down, roll to the right.

#include "mien/algorithms/faps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/rotation.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double angle_unit = 1e-5;

std::int32_t rounded(double value) {
    constexpr double most = 2e9;
    return static_cast<std::int32_t>(std::lround(std::clamp(value, -most, most)));
}

Quaternion turn_x(double angle) {
    return {std::sin(angle / 2), 0, 0, std::cos(angle / 2)};
}
Quaternion turn_y(double angle) {
    return {0, std::sin(angle / 2), 0, std::cos(angle / 2)};
}
Quaternion turn_z(double angle) {
    return {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
}

struct Turns {
    double yaw = 0, pitch = 0, roll = 0;
};

Quaternion rotation_of(const Turns& turns) {
    return turn_y(turns.yaw) * turn_x(turns.pitch) * turn_z(turns.roll);
}

// The third column of the matrix is (cos p sin y, -sin p, cos p cos y), its second row (cos p sin r, cos p cos r, -sin
// p).
Turns turns_of(const Quaternion& q) {
    const Vec3 z = rotate(q, {0, 0, 1});
    return {std::atan2(z.x, z.z), std::asin(std::clamp(-z.y, -1.0, 1.0)),
            std::atan2(rotate(q, {1, 0, 0}).y, rotate(q, {0, 1, 0}).y)};
}

double coordinate(const Vec3& v, FapAxis axis) {
    return axis == FapAxis::x ? v.x : axis == FapAxis::y ? v.y : v.z;
}

Vec3 along(FapAxis axis, double length) {
    return axis == FapAxis::x ? Vec3{length, 0, 0} : axis == FapAxis::y ? Vec3{0, length, 0} : Vec3{0, 0, length};
}

bool is_shift(const Fap& fap) {
    return fap.axis == FapAxis::x || fap.axis == FapAxis::y || fap.axis == FapAxis::z;
}

// The parameters of an eyeball.
struct EyeFaps {
    std::string_view pupil;
    int yaw, pitch, thrust;
};
constexpr std::array<EyeFaps, 2> eye_faps{{{"3.5", 23, 25, 27}, {"3.6", 24, 26, 28}}};

constexpr int tongue_roll = 47, head_pitch = 48, head_yaw = 49, head_roll = 50;

const Vec3& eye_centre(const Fapu& fapu, const EyeFaps& eye) {
    return eye.pupil == "3.5" ? fapu.left_eye : fapu.right_eye;
}

bool is_of_eye(const Fap& fap) {
    return fap.point == "3.5" || fap.point == "3.6";
}

bool lies_on_tongue(std::string_view point) {
    return point.starts_with("6.");
}

bool is_of_tongue(const Fap& fap) {
    return lies_on_tongue(fap.point);
}

double amount(const FapFrame& frame, const Fapu& fapu, int fap) {
    return frame.value[fap_index(fap)] * unit_length(fapu, fap_info(fap).unit);
}

Vec3 shift(const FapFrame& frame, const Fapu& fapu, std::span<const int> shifts) {
    Vec3 sum;
    for (const int fap : shifts) sum += along(fap_info(fap).axis, fap_info(fap).sign * amount(frame, fapu, fap));
    return sum;
}

// The tongue lies in the jaw and goes with it; its own parameters add to that.
Vec3 jaw_shift(const FapFrame& frame, const Fapu& fapu) {
    constexpr std::array jaw{3, 14, 15};
    return shift(frame, fapu, jaw);
}

struct EyePose {
    double yaw = 0, pitch = 0, thrust = 0;
};

// The pupil went from `before` to `now`, both seen from the ball's centre: now = thrust z + Ry(yaw) Rx(pitch) before.
// Thrust is what of its depth the ball does not explain; pitch, which keeps x, has to reach the height, and yaw the
// rest.
EyePose eye_pose(const Vec3& before, const Vec3& now) {
    const double radius = length(before);
    const double depth = std::sqrt(std::max(radius * radius - now.x * now.x - now.y * now.y, 0.0));
    EyePose pose;
    pose.thrust = now.z - depth;
    const double upright = std::hypot(before.y, before.z);
    if (!(upright > 0)) return pose;
    pose.pitch = std::acos(std::clamp(now.y / upright, -1.0, 1.0)) - std::atan2(before.z, before.y);
    const Vec3 pitched = rotate(turn_x(pose.pitch), before);
    pose.yaw = std::remainder(std::atan2(now.x, depth) - std::atan2(pitched.x, pitched.z), 2 * std::numbers::pi);
    return pose;
}

// Where each row of the take has what, and where it rests.
class Extractor {
public:
    Extractor(const Take& take, const Fapu& fapu) : take_(take), fapu_(fapu) {}

    FapFrame frame(std::size_t number, std::size_t row_number) const {
        FapFrame frame;
        frame.number = static_cast<std::uint32_t>(number);
        for (int fap = 3; fap <= 68; ++fap)
            if (is_shift(fap_info(fap)) && !is_of_eye(fap_info(fap))) add_shift(frame, row_number, fap);
        for (const EyeFaps& eye : eye_faps) add_eye(frame, row_number, eye);
        add_tongue_roll(frame, row_number);
        if (!take_.head.empty()) {
            const Turns turns = turns_of(take_.head[row_number].rotation);
            send(frame, head_pitch, turns.pitch / angle_unit);
            send(frame, head_yaw, turns.yaw / angle_unit);
            send(frame, head_roll, turns.roll / angle_unit);
        }
        return frame;
    }

private:
    static void send(FapFrame& frame, int fap, double value) {
        frame.mask.set(fap_index(fap));
        frame.value[fap_index(fap)] = rounded(value);
    }

    std::optional<Vec3> rest(std::string_view id) const {
        const auto i = find_point(fapu_.points, id);
        return i ? std::optional(fapu_.points[*i].position) : std::nullopt;
    }

    std::optional<Vec3> sample(std::size_t row_number, std::string_view id) const {
        const auto c = find_column(take_, id);
        if (!c || !is_finite(row(take_, row_number)[*c])) return std::nullopt;
        return row(take_, row_number)[*c];
    }

    // What the jaw's parameters, which come first, make of the tongue; nothing is known of it while the jaw is lost.
    std::optional<Vec3> carried(const FapFrame& frame, std::size_t row_number, const Fap& fap) const {
        if (!is_of_tongue(fap)) return Vec3{};
        if (find_column(take_, "2.1") && !sample(row_number, "2.1")) return std::nullopt;
        return jaw_shift(frame, fapu_);
    }

    void add_shift(FapFrame& frame, std::size_t row_number, int number) const {
        const Fap& fap = fap_info(number);
        const auto from = rest(fap.point), to = sample(row_number, fap.point);
        const double unit = unit_length(fapu_, fap.unit);
        const auto start = carried(frame, row_number, fap);
        if (from && to && start && unit > 0)
            send(frame, number, fap.sign * coordinate(*to - *from - *start, fap.axis) / unit);
    }

    void add_eye(FapFrame& frame, std::size_t row_number, const EyeFaps& eye) const {
        const auto from = rest(eye.pupil), to = sample(row_number, eye.pupil);
        if (!from || !to) return;
        const Vec3& centre = eye_centre(fapu_, eye);
        const EyePose pose = eye_pose(*from - centre, *to - centre);
        send(frame, eye.yaw, pose.yaw / angle_unit);
        send(frame, eye.pitch, pose.pitch / angle_unit);
        send(frame, eye.thrust, pose.thrust / unit_length(fapu_, FapUnit::es));
    }

    // The mean turn of the edges about the body of the tongue, upwards.
    void add_tongue_roll(FapFrame& frame, std::size_t row_number) const {
        const auto body = rest("6.2"), body_now = sample(row_number, "6.2");
        double sum = 0;
        int count = 0;
        for (const auto& [id, side] : {std::pair("6.3", 1.0), std::pair("6.4", -1.0)}) {
            const auto from = rest(id), to = sample(row_number, id);
            if (!body || !from || !to) continue;
            const Vec3 before = *from - *body, now = *to - body_now.value_or(*body + jaw_shift(frame, fapu_));
            const double turn = std::atan2(now.y, side * now.x) - std::atan2(before.y, side * before.x);
            sum += std::remainder(turn, 2 * std::numbers::pi);
            ++count;
        }
        if (count > 0) send(frame, tongue_roll, sum / count / angle_unit);
    }

    const Take& take_;
    const Fapu& fapu_;
};

// Without what the differences of times lose: 25, not 24.999999999999979.
double plain_rate(double rate) {
    const double plain = std::round(1000 * rate) / 1000;
    return std::abs(rate - plain) < 1e-6 * rate ? plain : rate;
}

// A frame and the row that shows it.
struct Shown {
    std::size_t number = 0, row = 0;
    double offset = 0;  // in frames
};

// Of the rows within half a frame of a frame's time the nearest, the earlier of two.
std::vector<Shown> shown_rows(const Take& take, double rate) {
    std::vector<Shown> shown;
    for (std::size_t r = 0; r < row_count(take); ++r) {
        const double at = (take.times[r] - take.times.front()) * rate;
        if (!(at < 2e9)) throw Error(fmt::format("to FAPs: expected less than 2e9 frames, found {} s", take.times[r]));
        const double number = std::round(at), offset = std::abs(at - number);
        const Shown here{static_cast<std::size_t>(number), r, offset};
        if (shown.empty() || shown.back().number != here.number)
            shown.push_back(here);
        else if (offset < shown.back().offset)
            shown.back() = here;
    }
    return shown;
}

}  // namespace

FapStream to_faps(const Take& take, const Fapu& fapu, const ToFapsOptions& options) {
    if (row_count(take) == 0) throw Error("to FAPs: expected a take with rows, found none");
    if (!(options.rate >= 0) || !std::isfinite(options.rate))
        throw Error(fmt::format("to FAPs: expected a rate from 0, found {}", options.rate));
    FapStream stream;
    if (row_count(take) > 1) stream.rate = plain_rate(frame_rate(take));
    if (options.rate > 0) stream.rate = options.rate;
    const Extractor extractor(take, fapu);
    for (const Shown& shown : shown_rows(take, stream.rate))
        stream.frames.push_back(extractor.frame(shown.number, shown.row));
    return stream;
}

namespace {

// Which parameters move a point of the face; numbers from 1.
std::vector<std::vector<int>> shifts_by_point(const Fapu& fapu) {
    std::vector<std::vector<int>> shifts(fapu.points.size());
    for (int fap = 3; fap <= 68; ++fap)
        if (const auto i = find_point(fapu.points, fap_info(fap).point);
            i && is_shift(fap_info(fap)) && !is_of_eye(fap_info(fap)))
            shifts[*i].push_back(fap);
    return shifts;
}

Vec3 moved_pupil(const FapFrame& frame, const Fapu& fapu, const EyeFaps& eye, const Vec3& pupil) {
    const Vec3& centre = eye_centre(fapu, eye);
    const Turns turns{amount(frame, fapu, eye.yaw), amount(frame, fapu, eye.pitch), 0};
    return centre + rotate(rotation_of(turns), pupil - centre) + along(FapAxis::z, amount(frame, fapu, eye.thrust));
}

// The edge goes with the body of the tongue and turns upwards about it.
Vec3 moved_edge(const FapFrame& frame, const Fapu& fapu, const Vec3& edge, double side) {
    const auto i = find_point(fapu.points, "6.2");
    if (!i) return edge + jaw_shift(frame, fapu);
    const Vec3 body = fapu.points[*i].position;
    constexpr int raise_tongue = 46;
    const Quaternion turn = turn_z(side * amount(frame, fapu, tongue_roll));
    return body + rotate(turn, edge - body) + jaw_shift(frame, fapu) +
           along(FapAxis::y, amount(frame, fapu, raise_tongue));
}

Vec3 moved(const FapFrame& frame, const Fapu& fapu, const FeaturePoint& point, const std::vector<int>& shifts) {
    for (const EyeFaps& eye : eye_faps)
        if (point.id == eye.pupil) return moved_pupil(frame, fapu, eye, point.position);
    if (point.id == "6.3") return moved_edge(frame, fapu, point.position, 1);
    if (point.id == "6.4") return moved_edge(frame, fapu, point.position, -1);
    const Vec3 carried = lies_on_tongue(point.id) ? jaw_shift(frame, fapu) : Vec3{};
    return point.position + carried + shift(frame, fapu, shifts);
}

Pose head_pose(const FapFrame& frame, const Fapu& fapu) {
    const Quaternion rotation =
        rotation_of({amount(frame, fapu, head_yaw), amount(frame, fapu, head_pitch), amount(frame, fapu, head_roll)});
    return {rotation, fapu.neck - rotate(rotation, fapu.neck)};
}

}  // namespace

Take to_take(const FapStream& stream, const Fapu& fapu) {
    Take take;
    for (const FeaturePoint& point : fapu.points) take.points.push_back(point.id);
    const std::vector<std::vector<int>> shifts = shifts_by_point(fapu);
    bool head_moves = false;
    take.samples.reserve(stream.frames.size() * fapu.points.size());
    for (const FapFrame& frame : stream.frames) {
        take.times.push_back(frame.number / stream.rate);
        for (std::size_t i = 0; i < fapu.points.size(); ++i)
            take.samples.push_back(moved(frame, fapu, fapu.points[i], shifts[i]));
        take.head.push_back(head_pose(frame, fapu));
        for (const int fap : {head_pitch, head_yaw, head_roll}) head_moves = head_moves || frame.mask[fap_index(fap)];
    }
    if (!head_moves) take.head.clear();
    return take;
}

}  // namespace mien
