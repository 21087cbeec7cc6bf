// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/fba_bits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien::fba {
namespace {

struct Coded {
    Model model;
    int level;
};

// Symbols of adaptive alphabets, most of them near `centre` (0 to 1) of their alphabet.
std::vector<Coded> random_symbols(std::mt19937& random, std::size_t count, int most, double centre) {
    std::vector<Coded> symbols;
    for (std::size_t k = 0; k < count; ++k) {
        const int low = -static_cast<int>(random() % static_cast<unsigned>(most));
        const int high = static_cast<int>(random() % static_cast<unsigned>(most));
        Model model(low, high);
        std::uniform_real_distribution<double> spread(0, 1);
        const auto any = [&] {
            const double at = random() % 8 == 0 ? spread(random) : centre;
            return low + static_cast<int>(std::lround(at * (high - low)));
        };
        for (auto n = random() % 300; n > 0; --n) model.add(static_cast<std::uint32_t>(any() - low));
        symbols.push_back({model, any()});
    }
    return symbols;
}

std::string bit_text(const std::string& bytes, std::size_t bits) {
    std::string text;
    for (std::size_t i = 0; i < bits; ++i)
        text += ((static_cast<unsigned char>(bytes[i / 8]) >> (7 - i % 8)) & 1) != 0 ? '1' : '0';
    return text;
}

TEST(FbaBits, EveryRunReadsBackAndLeavesWhatFollowsUntouched) {
    std::mt19937 random(3);
    std::size_t stuffed = 0;
    for (int k = 0; k < 4000; ++k) {
        // The last symbol of an alphabet is the lowest part of the interval: many of them make runs of zeros.
        const double centre = k % 3 == 0 ? 1 : k % 3 == 1 ? 0 : 0.5;
        const auto symbols = random_symbols(random, random() % 60, 1 + 1860 / (1 + k % 40), centre);
        BitWriter bits;
        bits.put(random() % 2 == 0 ? 0 : 0x7FFF, static_cast<int>(random() % 16));
        const std::size_t begin = bits.position();
        RunWriter run(bits);
        for (const Coded& symbol : symbols) run.put(symbol.model, symbol.level);
        run.finish();
        const std::size_t end = bits.position();
        const std::uint32_t follows = k % 2 == 0 ? 0 : 0xA5A5A5A5;
        bits.put(follows, 32);
        bits.put(follows, 32);
        const std::string bytes = bits.take();
        stuffed += bit_text(bytes, end).find(std::string(22, '0') + '1', begin) != std::string::npos ? 1U : 0U;
        EXPECT_EQ(bit_text(bytes, end).find(std::string(23, '0'), begin), std::string::npos);

        BitReader reader(as_bytes(bytes));
        reader.seek(begin);
        RunReader back(reader);
        for (const Coded& symbol : symbols) ASSERT_EQ(back.get(symbol.model), symbol.level);
        back.finish();
        ASSERT_EQ(reader.position(), end) << "run " << k;
        EXPECT_EQ(reader.get(32), follows);
    }
    EXPECT_GT(stuffed, 100U);
}

TEST(FbaBits, ARunIsAsLongAsItsSymbolsAreUnlikely) {
    std::mt19937 random(5);
    for (int k = 0; k < 50; ++k) {
        Model model(-20, 20);
        std::vector<double> counts(41, 1);
        std::binomial_distribution<int> near_the_middle(40, 0.5);
        BitWriter bits;
        RunWriter run(bits);
        double ideal = 0;
        for (int n = 0; n < 2000; ++n) {
            const int symbol = near_the_middle(random);
            run.put(model, symbol - 20);
            ideal -= std::log2(counts[static_cast<std::size_t>(symbol)] / (41 + n));
            model.add(static_cast<std::uint32_t>(symbol));
            ++counts[static_cast<std::size_t>(symbol)];
        }
        run.finish();
        EXPECT_NEAR(static_cast<double>(bits.position()), ideal, 0.005 * ideal + 4);
    }
}

TEST(FbaBits, CountsAreHalvedWhenTheTotalComesTo16383) {
    Model model(0, 2);
    std::array<std::uint32_t, 3> counts{1, 1, 1};
    std::mt19937 random(9);
    for (int n = 0; n < 100000; ++n) {
        const auto symbol = static_cast<std::uint32_t>(random() % 7 == 0 ? random() % 3 : 1);
        if (std::accumulate(counts.begin(), counts.end(), 0U) == 16383)
            for (auto& count : counts) count = (count + 1) / 2;
        ++counts[symbol];
        model.add(symbol);
        ASSERT_EQ(model.total(), counts[0] + counts[1] + counts[2]);
        ASSERT_EQ(model.seen_before(1), counts[0]);
        ASSERT_EQ(model.seen_before(2), counts[0] + counts[1]);
    }
}

TEST(FbaBits, EveryCountFallsIntoItsSymbol) {
    std::mt19937 random(2);
    for (const int size : {1, 2, 3, 7, 8, 9, 121, 3721}) {
        Model model(0, size - 1);
        for (int round = 0; round < 2; ++round) {
            for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(size); ++s) {
                EXPECT_EQ(model.symbol_at(model.seen_before(s)), s);
                EXPECT_EQ(model.symbol_at(model.seen_before(s + 1) - 1), s);
            }
            for (int n = 0; n < 500; ++n) model.add(static_cast<std::uint32_t>(random() % static_cast<unsigned>(size)));
        }
    }
}

TEST(FbaBits, AStartCodeIsFoundBehindItsPaddingAndNowhereElse) {
    for (int before = 0; before < 8; ++before) {
        BitWriter bits;
        bits.put(0x55, before);
        bits.put_start_code(plane_start);
        bits.put(0xFF, 8);
        const std::string bytes = bits.take();
        BitReader reader(as_bytes(bytes));
        reader.seek(static_cast<std::size_t>(before));
        EXPECT_EQ(reader.start_code(), plane_start);
        EXPECT_EQ(reader.get(8), 0xFFU);
        reader.seek(static_cast<std::size_t>(before) + 1);
        if (before != 0 && before != 7) {
            EXPECT_EQ(reader.start_code(), std::nullopt);
        }
    }
    const std::string whole_byte("\x7F\x00\x00\x01\xB1", 5), zeros("\x80\x00\x00\x01\xBB", 5);
    EXPECT_EQ(BitReader(as_bytes(whole_byte)).start_code(), object_end);
    BitReader reader(as_bytes(zeros));
    reader.get(1);
    EXPECT_EQ(reader.start_code(), plane_start);
    EXPECT_EQ(BitReader({}).start_code(), std::nullopt);
}

TEST(FbaBits, AWrongStuffingBitIsAnErrorInsideTheRunAndNoneBehindIt) {
    BitWriter bits;
    for (int n = 0; n < 12; ++n) bits.put(0, 8);
    const std::string bytes = bits.take();
    BitReader reader(as_bytes(bytes));
    RunReader run(reader);
    const Model model(0, 255);
    run.get(model);
    run.finish();  // 8 of its own bits, the zeros behind them are others'
    reader.seek(0);
    RunReader longer(reader);
    for (int n = 0; n < 4; ++n) longer.get(model);
    EXPECT_THROW(longer.finish(), Error);
}

}  // namespace
}  // namespace mien::fba
