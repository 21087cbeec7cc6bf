// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cmath>
#include <limits>

namespace mien {

/// A point or a displacement in space. MPEG-4 axes wherever a face is meant: +x the subject's left, +y up, +z out of
/// the face. `Vec3f` is for geometry that is shown, `Vec3` for solving and for captured samples.
template <class T>
struct BasicVec3 {
    T x = 0, y = 0, z = 0;

    friend constexpr bool operator==(const BasicVec3&, const BasicVec3&) = default;

    constexpr BasicVec3& operator+=(const BasicVec3& b) { return *this = *this + b; }
    constexpr BasicVec3& operator-=(const BasicVec3& b) { return *this = *this - b; }

    friend constexpr BasicVec3 operator+(const BasicVec3& a, const BasicVec3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend constexpr BasicVec3 operator-(const BasicVec3& a, const BasicVec3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend constexpr BasicVec3 operator-(const BasicVec3& a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr BasicVec3 operator*(T s, const BasicVec3& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend constexpr BasicVec3 operator*(const BasicVec3& a, T s) { return s * a; }
    friend constexpr BasicVec3 operator/(const BasicVec3& a, T s) { return {a.x / s, a.y / s, a.z / s}; }
};

using Vec3 = BasicVec3<double>;
using Vec3f = BasicVec3<float>;

/// A texture coordinate: u to the right, v downwards from the top left corner of the picture, as in glTF.
struct Vec2f {
    float x = 0, y = 0;
    friend constexpr bool operator==(const Vec2f&, const Vec2f&) = default;
};

template <class T>
constexpr T dot(const BasicVec3<T>& a, const BasicVec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr BasicVec3<T> cross(const BasicVec3<T>& a, const BasicVec3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(const BasicVec3<T>& a) {
    return std::sqrt(dot(a, a));
}

template <class T>
T distance(const BasicVec3<T>& a, const BasicVec3<T>& b) {
    return length(a - b);
}

template <class T>
bool is_finite(const BasicVec3<T>& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

constexpr Vec3 to_double(const Vec3f& a) {
    return {a.x, a.y, a.z};
}
constexpr Vec3f to_float(const Vec3& a) {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Marks a lost sample in a take.
inline constexpr Vec3 lost_sample{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::quiet_NaN()};

/// A unit quaternion (x, y, z, w); the default turns nothing.
struct Quaternion {
    double x = 0, y = 0, z = 0, w = 1;
    friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

constexpr Quaternion conjugate(const Quaternion& q) {
    return {-q.x, -q.y, -q.z, q.w};
}

/// `v` turned by `q`.
constexpr Vec3 rotate(const Quaternion& q, const Vec3& v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0 * cross(u, v);
    return v + q.w * t + cross(u, t);
}

/// A rigid motion: p -> rotate(rotation, p) + translation. Translation in the unit of the points it moves.
struct Pose {
    Quaternion rotation;
    Vec3 translation;
    friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

constexpr Vec3 apply(const Pose& pose, const Vec3& p) {
    return rotate(pose.rotation, p) + pose.translation;
}

}  // namespace mien
