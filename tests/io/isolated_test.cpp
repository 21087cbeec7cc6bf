// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/isolated.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "refusal.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

constexpr IsolatedLimits limits{std::uint64_t{64} << 20U, 1};

template <class Work>
std::string refused(const Work& work) {
    return refusal([&] { run_isolated("thing", limits, work); });
}

std::vector<std::byte> nothing() {
    return {};
}

TEST(Isolated, the_result_comes_back_whole_however_long) {
    EXPECT_TRUE(run_isolated("thing", limits, nothing).empty());
    std::vector<std::byte> many(5000000);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::byte>(i * i % 251);
    EXPECT_EQ(run_isolated("thing", limits, [&] { return many; }), many);
}

TEST(Isolated, what_is_thrown_there_is_an_error_here) {
    EXPECT_EQ(refused([]() -> std::vector<std::byte> { throw Error("byte 7: no"); }), "byte 7: no");
    EXPECT_EQ(refused([]() -> std::vector<std::byte> { throw std::runtime_error("other"); }), "other");
    EXPECT_THAT(refused([]() -> std::vector<std::byte> { throw 7; }), HasSubstr("expected a file that can be read"));
}

TEST(Isolated, a_crash_there_is_an_error_here) {
    const std::string sentence = "thing: expected a file that can be read within 1 s and 64 MB, found one that cannot";
    EXPECT_EQ(refused([] { return std::abort(), nothing(); }), sentence);
    EXPECT_EQ(refused([] { return std::_Exit(3), nothing(); }), sentence);
    EXPECT_EQ(refused([] { return std::raise(SIGSEGV), nothing(); }), sentence);
}

TEST(Isolated, work_without_end_is_ended) {
    EXPECT_THAT(refused([] {
                    volatile bool forever = true;
                    while (forever) {
                    }
                    return nothing();
                }),
                HasSubstr("within 1 s"));
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(Isolated, memory_beyond_the_limit_is_refused) {
    EXPECT_THAT(refused([] {
                    std::vector<std::byte> large(std::size_t{512} << 20U, std::byte{1});
                    const volatile std::byte* kept = large.data();  // or an optimiser takes the allocation away
                    return std::vector<std::byte>{kept[12345]};
                }),
                HasSubstr("fits into the memory"));
}
#endif

TEST(Isolated, nothing_of_it_is_seen_here) {
    int here = 1;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    run_isolated("thing", limits, [&] {
        here = 2;
        std::puts("to be seen by nobody");
        std::fputs("nor this", stderr);
        std::fflush(stdout);
        return nothing();
    });
    EXPECT_EQ(here, 1);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace mien
