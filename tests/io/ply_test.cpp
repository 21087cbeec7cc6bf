// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/ply.hpp"

#include <bit>
#include <cstdint>
#include <gtest/gtest.h>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_ply, text);
}

Mesh parse(std::string_view text) {
    return parse_ply(hostile::Copy(text).bytes());
}

std::string header(const std::string& encoding, const std::string& vertices, const std::string& faces,
                   const std::string& list = "list uchar int vertex_indices") {
    return "ply\nformat " + encoding + " 1.0\ncomment by hand\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces + "\nproperty " + list +
           "\nend_header\n";
}

const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

// One value as bytes, the lowest or the highest first.
template <class T>
std::string bytes_of(T value, bool big) {
    std::string bytes(sizeof(T), '\0');
    const auto* raw = reinterpret_cast<const char*>(&value);
    for (std::size_t i = 0; i < sizeof(T); ++i)
        bytes[i] = raw[(std::endian::native == std::endian::big) == big ? i : sizeof(T) - 1 - i];
    return bytes;
}

std::string binary_triangle(bool big) {
    std::string text = header(big ? "binary_big_endian" : "binary_little_endian", "3", "1");
    for (const float number : {0.F, 0.F, 0.F, 1.5F, 0.F, 0.F, 0.F, 1.F, 0.F}) text += bytes_of(number, big);
    text += '\3';
    for (const std::int32_t index : {0, 1, 2}) text += bytes_of(index, big);
    return text;
}

TEST(Ply, refuses_what_breaks_its_promise_and_names_the_place) {
    EXPECT_THAT(refusal(""), HasSubstr("ply line 1: expected ply"));
    EXPECT_THAT(refusal("ply\nformat ascii 1.0\n"), HasSubstr("end_header"));
    EXPECT_THAT(refusal("ply\nend_header\n"), HasSubstr("format"));
    EXPECT_THAT(refusal("ply\nformat ascii 2.0\nend_header\n"), HasSubstr("version 1.0"));
    EXPECT_THAT(refusal("ply\nproperty int x\nend_header\n"), HasSubstr("an element before its first property"));
    EXPECT_THAT(refusal(header("ascii", "-3", "1") + triangle), HasSubstr("found '-3'"));
    EXPECT_THAT(refusal(header("ascii", "3", "0") + triangle), HasSubstr("expected faces"));
    EXPECT_THAT(refusal(header("ascii", "1000000000000000000", "1") + triangle), HasSubstr("at most"));
    EXPECT_THAT(refusal(header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n"), HasSubstr("found -2"));
    EXPECT_THAT(refusal(header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), HasSubstr("ply line 14"));
    EXPECT_THAT(refusal(header("ascii", "3", "1") + "0 0 nan\n"), HasSubstr("a finite coordinate"));
    EXPECT_THAT(refusal(header("ascii", "3", "1") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), HasSubstr("an integer"));
    EXPECT_THAT(refusal(header("ascii", "3", "1") + triangle + "7"), HasSubstr("expected the end of the file"));
    EXPECT_THAT(refusal(header("ascii", "3", "1", "list uchar float vertex_indices") + triangle),
                HasSubstr("integer list"));
    EXPECT_THAT(refusal(header("ascii", "3", "1", "list float int vertex_indices") + triangle),
                HasSubstr("integer type"));
    EXPECT_THAT(refusal(header("ascii", "3", "1", "list uchar int strips") + triangle), HasSubstr("vertex_indices"));
}

TEST(Ply, lists_longer_than_the_file_are_refused_before_memory_is_asked_for) {
    const std::string text = header("binary_little_endian", "0", "1", "list uint double vertex_indices");
    EXPECT_THAT(refusal(text + "\xff\xff\xff\xff"), HasSubstr("integer list"));
    EXPECT_THAT(refusal(header("binary_little_endian", "0", "1", "list uint int vertex_index") + "\xff\xff\xff\xff"),
                HasSubstr("a list of at most 0 entries"));
}

TEST(Ply, lists_of_negative_length_are_refused) {
    const std::string list = "list char int vertex_index";
    EXPECT_THAT(refusal(header("ascii", "3", "1", list) + "0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n"), HasSubstr("found -1"));
    EXPECT_THAT(refusal(header("binary_big_endian", "0", "1", list) + "\xff"), HasSubstr("found -1"));
}

TEST(Ply, a_binary_body_that_ends_early_is_refused) {
    for (const bool big : {false, true}) {
        const std::string whole = binary_triangle(big);
        for (std::size_t size = whole.size() - 49; size < whole.size(); ++size)
            EXPECT_THAT(refusal(whole.substr(0, size)), HasSubstr("ply ")) << size;
    }
}

TEST(Ply, numbers_of_every_type_and_sign_read_in_both_byte_orders) {
    for (const bool big : {false, true}) {
        std::string text = "ply\nformat "s + (big ? "binary_big_endian" : "binary_little_endian") +
                           " 1.0\nelement vertex 2\nproperty uchar a\nproperty char x\nproperty ushort b\n"
                           "property short y\nproperty uint c\nproperty int z\nelement face 1\n"
                           "property list ushort uint vertex_index\nproperty double d\nend_header\n";
        for (int vertex = 0; vertex < 2; ++vertex)
            text += bytes_of(std::uint8_t{200}, big) + bytes_of(std::int8_t{-2}, big) +
                    bytes_of(std::uint16_t{60000}, big) + bytes_of(std::int16_t{-300}, big) +
                    bytes_of(std::uint32_t{4000000000U}, big) + bytes_of(std::int32_t{-70000}, big);
        text += bytes_of(std::uint16_t{3}, big);
        for (const std::uint32_t index : {0U, 1U, 0U}) text += bytes_of(index, big);
        const Mesh mesh = parse(text + bytes_of(0.1, big));
        EXPECT_EQ(mesh.positions[1], (Vec3f{-2, -300, -70000}));
        EXPECT_EQ(mesh.face_vertices, (std::vector<std::uint32_t>{0, 1, 0}));
    }
}

TEST(Ply, elements_without_properties_cost_nothing) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement nothing 1000000000000000000\n" + header("ascii", "3", "1").substr(21);
    EXPECT_EQ(face_count(parse(text + triangle)), 1U);
}

TEST(Ply, text_and_both_byte_orders_give_the_same_mesh) {
    const Mesh text = parse(header("ascii", "3", "1") + "0 0 0\n1.5 0 0\n0 1 0\n3 0 1 2\n");
    for (const bool big : {false, true}) {
        const Mesh binary = parse(binary_triangle(big));
        EXPECT_EQ(binary.positions, text.positions);
        EXPECT_EQ(binary.face_vertices, text.face_vertices);
    }
}

TEST(Ply, the_body_may_begin_with_a_line_feed) {
    const std::string text = header("binary_little_endian", "3", "1", "list uchar uchar vertex_index");
    std::string body;
    body += "\n\0\0\0"s + std::string(32, '\0');
    const Mesh mesh = parse(text + body + "\3\0\1\2"s);
    EXPECT_EQ(mesh.positions[0].x, std::bit_cast<float>(std::uint32_t{10}));
    EXPECT_EQ(mesh.face_vertices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Ply, header_lines_may_end_in_cr_lf) {
    std::string text = header("ascii", "3", "1") + triangle;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
    EXPECT_EQ(face_count(parse(text)), 1U);
    const std::string binary = binary_triangle(false);
    const std::size_t body = binary.find("end_header\n") + 11;
    for (const std::string end : {"\r\n", "\r"}) {
        std::string head = binary.substr(0, body);
        for (std::size_t at = 0; (at = head.find('\n', at)) != std::string::npos; at += end.size())
            head.replace(at, 1, end);
        EXPECT_EQ(parse(head + binary.substr(body)).positions[1].x, 1.5F);
    }
}

TEST(Ply, other_elements_and_properties_of_every_type_are_skipped) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement camera 1\nproperty list uint8 double values\n  element\tvertex 3\n"
        "property char a\nproperty uint16 b\nproperty double x\nproperty int16 y\nproperty float32 z\nproperty uchar "
        "red\n"
        "element face 2\nproperty uint flags\nproperty list ushort uint vertex_index\nproperty list uchar float "
        "texcoord\n"
        "element edge 1\nproperty int v\nend_header\n2 0.5 1e3\n-1 2 0.25 3 4 255\n0 0 1 1 1 0\n0 0 2 2 2 0\n"
        "9 3 2 1 0 2 0.5 0.5\n9 2 0 1 0\n7\n";
    const Mesh mesh = parse(text);
    EXPECT_EQ(mesh.positions[0], (Vec3f{0.25F, 3, 4}));
    EXPECT_EQ(mesh.face_vertices, (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(Ply, survives_every_prefix_and_every_changed_byte) {
    const auto promise = [](const Mesh& mesh) { return hostile::keeps_promise(mesh); };
    hostile::sweep(parse_ply, header("ascii", "3", "1") + triangle, promise);
    hostile::sweep(parse_ply, binary_triangle(true), promise);
    hostile::sweep(parse_ply, binary_triangle(false), promise);
}

}  // namespace
}  // namespace mien
