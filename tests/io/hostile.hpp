// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What every parser is put through: each prefix of a good file and each byte of it changed, in an allocation of exactly
// its size so that a sanitizer sees one byte too far.

#pragma once

#include <algorithm>
#include <cstddef>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <locale>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/promise.hpp"
#include "refusal.hpp"

#include "mien/error.hpp"

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
    return mien::refusal([&] { parse(copy.bytes()); });
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
