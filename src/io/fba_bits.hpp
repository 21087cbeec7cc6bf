// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Bits, most significant first, and the arithmetic coder of the face animation bitstream.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mien::fba {

inline constexpr std::uint32_t object_start = 0x000001BA, plane_start = 0x000001BB, object_end = 0x000001B1;

class BitWriter {
public:
    void put(std::uint32_t value, int count);
    void put_flag(bool flag) { put(flag ? 1 : 0, 1); }
    /// A zero, then ones to the next byte (none when at its beginning), then the code.
    void put_start_code(std::uint32_t code);

    [[nodiscard]] std::size_t position() const { return position_; }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
    std::size_t position_ = 0;
};

class BitReader {
public:
    explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// Throws Error at the end of the bytes.
    std::uint32_t get(int count);
    bool get_flag() { return get(1) == 1; }
    void expect_marker();
    /// Goes over a start code at the next byte and returns it, or returns nothing and stays.
    std::optional<std::uint32_t> start_code();

    [[nodiscard]] std::size_t position() const { return position_; }
    void seek(std::size_t position) { position_ = position; }

    /// Throws Error: "fba byte 12: ...".
    [[noreturn]] void fail(std::string_view sentence) const;

private:
    [[nodiscard]] std::optional<std::uint32_t> code_at(std::size_t byte) const;
    [[nodiscard]] bool bit_at(std::size_t position) const;

    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
};

/// How often each symbol of an alphabet was seen, which starts at once each. The alphabet is low .. high; its table is
/// only built when the first symbol is counted, as a Fenwick tree, since alphabets reach 3,721 symbols.
class Model {
public:
    Model(int low, int high) : low_(low), size_(static_cast<std::uint32_t>(high - low + 1)), total_(size_) {}
    Model() : Model(0, 0) {}

    [[nodiscard]] int low() const { return low_; }
    [[nodiscard]] std::uint32_t total() const { return total_; }
    /// Of all symbols before this one, counted from 0.
    [[nodiscard]] std::uint32_t seen_before(std::uint32_t symbol) const;
    /// The symbol that the count falls into.
    [[nodiscard]] std::uint32_t symbol_at(std::uint32_t count) const;
    /// One more of it; when the total has come to 16,383, all are halved first.
    void add(std::uint32_t symbol);

private:
    void build(std::vector<std::uint32_t> counts);
    void halve();

    int low_;
    std::uint32_t size_, total_;
    std::vector<std::uint32_t> tree_;  // 1-based; empty while every count is 1
};

/// Writes one run of symbols. After 22 zeros a 1 is stuffed, so that no start code can appear.
class RunWriter {
public:
    explicit RunWriter(BitWriter& bits) : bits_(bits) {}
    void put(const Model& model, int level);
    void finish();

private:
    void put_bit(bool bit);
    void put_with_opposites(bool bit);

    BitWriter& bits_;
    std::uint32_t low_ = 0, high_ = 65535;
    std::size_t opposites_ = 0;
    int zeros_ = 0;
};

/// Reads one run of symbols. It looks 14 bits ahead of them; `finish` gives these back.
class RunReader {
public:
    explicit RunReader(BitReader& bits);
    int get(const Model& model);
    void finish();

private:
    bool get_bit();

    BitReader& bits_;
    std::uint32_t low_ = 0, high_ = 65535, code_ = 0;
    std::size_t read_ = 0;
    int zeros_ = 0;
    std::array<std::size_t, 16> after_{};  // where the bits behind each of the last 16 begin
    std::size_t first_bad_ = 0;            // the bit behind which the stuffing was wrong; 0 for none
};

}  // namespace mien::fba
