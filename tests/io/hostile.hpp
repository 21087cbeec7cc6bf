// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What every parser is put through: each prefix of a good file and each byte of it changed, in an allocation of exactly
// its size so that a sanitizer sees one byte too far.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <locale>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mien/error.hpp"
#include "mien/mesh.hpp"
#include "mien/take.hpp"

namespace mien::hostile {

/// The text in memory of its own, of exactly its size.
class Copy {
public:
    explicit Copy(std::string_view text) : size_(text.size()), bytes_(std::make_unique<std::byte[]>(text.size())) {
        std::transform(text.begin(), text.end(), bytes_.get(), [](char c) { return static_cast<std::byte>(c); });
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.get(), size_}; }

private:
    std::size_t size_;
    std::unique_ptr<std::byte[]> bytes_;
};

/// What the parser made of the text, or nothing when it threw Error with a sentence.
template <class Parse>
auto attempt(const Parse& parse, std::string_view text) -> std::optional<decltype(parse(Copy(text).bytes()))> {
    const Copy copy(text);
    try {
        return parse(copy.bytes());
    } catch (const Error& error) {
        EXPECT_FALSE(std::string_view(error.what()).empty());
        return std::nullopt;
    }
}

/// The sentence with which the parser refuses the text; empty when it does not.
template <class Parse>
std::string refusal(const Parse& parse, std::string_view text) {
    const Copy copy(text);
    try {
        parse(copy.bytes());
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// Whether the promise of every reader holds for this mesh.
inline bool keeps_promise(const Mesh& mesh) {
    const auto in_range = [&](std::uint32_t v) { return v < mesh.positions.size(); };
    const auto uv_finite = [](const Vec2f& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); };
    bool good = mesh.face_starts.front() == 0 && mesh.face_starts.back() == mesh.face_vertices.size();
    for (std::size_t f = 0; f < face_count(mesh); ++f)
        good = good && mesh.face_starts[f] + 3 <= mesh.face_starts[f + 1];
    for (const Part& part : mesh.parts)
        good = good && std::uint64_t{part.first_vertex} + part.vertex_count <= mesh.positions.size() &&
               std::uint64_t{part.first_face} + part.face_count <= face_count(mesh);
    good = good && (mesh.corner_uvs.empty() || mesh.corner_uvs.size() == mesh.face_vertices.size());
    return good && std::all_of(mesh.face_vertices.begin(), mesh.face_vertices.end(), in_range) &&
           std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite<float>) &&
           std::all_of(mesh.corner_uvs.begin(), mesh.corner_uvs.end(), uv_finite);
}

/// Times rise; a sample is finite or lost as a whole.
inline bool keeps_promise(const Take& take) {
    const auto whole = [](const Vec3& p) {
        return is_finite(p) || (std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z));
    };
    bool good = take.samples.size() == take.times.size() * take.points.size() && !take.times.empty();
    for (std::size_t r = 0; r < take.times.size(); ++r)
        good = good && std::isfinite(take.times[r]) && (r == 0 || take.times[r - 1] < take.times[r]);
    return good && std::all_of(take.samples.begin(), take.samples.end(), whole);
}

/// Every prefix of the text, and the text with every byte one up, one down, 0 and 255: refused or as promised.
template <class Parse, class Promise>
void sweep(const Parse& parse, std::string_view text, const Promise& promise) {
    const auto check = [&](const std::string& changed, std::size_t at) {
        const auto result = attempt(parse, changed);
        EXPECT_TRUE(!result || promise(*result)) << "byte " << at;
    };
    for (std::size_t size = 0; size < text.size(); ++size) check(std::string(text.substr(0, size)), size);
    for (std::size_t at = 0; at < text.size(); ++at)
        for (const int value : {text[at] + 1, text[at] - 1, 0, 255}) {
            std::string changed(text);
            changed[at] = static_cast<char>(value);
            check(changed, at);
        }
}

/// Sets a locale whose decimal point is a comma while it lives; `there` tells whether the system has one.
class CommaLocale {
public:
    CommaLocale() {
        for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8"}) {
            if (std::setlocale(LC_ALL, name) == nullptr) continue;
            before_ = std::locale::global(std::locale(name));
            there = true;
            return;
        }
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;
    ~CommaLocale() {
        std::locale::global(before_);
        std::setlocale(LC_ALL, "C");
    }
    bool there = false;

private:
    std::locale before_;
};

}  // namespace mien::hostile
