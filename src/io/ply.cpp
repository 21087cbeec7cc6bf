// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Stanford PLY (Turk 1994), text and binary of both byte orders. Every value passes through one function that reads a
// scalar of a declared type, so text and binary share everything else. Counts are promises of a stranger: before a
// record or a list is read, the bytes left must be able to hold it.

#include "mien/io/ply.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Encoding { ascii, little, big };

constexpr std::array<std::pair<std::string_view, Type>, 16> type_names{{{"char", Type::int8},
                                                                        {"int8", Type::int8},
                                                                        {"uchar", Type::uint8},
                                                                        {"uint8", Type::uint8},
                                                                        {"short", Type::int16},
                                                                        {"int16", Type::int16},
                                                                        {"ushort", Type::uint16},
                                                                        {"uint16", Type::uint16},
                                                                        {"int", Type::int32},
                                                                        {"int32", Type::int32},
                                                                        {"uint", Type::uint32},
                                                                        {"uint32", Type::uint32},
                                                                        {"float", Type::float32},
                                                                        {"float32", Type::float32},
                                                                        {"double", Type::float64},
                                                                        {"float64", Type::float64}}};

std::size_t size_of(Type type) {
    if (type == Type::float64) return 8;
    if (type == Type::int8 || type == Type::uint8) return 1;
    return type == Type::int16 || type == Type::uint16 ? 2 : 4;
}

bool is_integer(Type type) {
    return type != Type::float32 && type != Type::float64;
}

struct Property {
    std::string name;
    Type type = Type::float32;
    std::optional<Type> list_count;  // a list: the type of its length
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::size_t size = 0;  // bytes up to the body
};

// ---- header

struct HeaderReader {
    std::string_view text;
    std::size_t at = 0, number = 0;
    std::string_view end_of_line = "\n";  // as the first line ends: the body starts right behind the last such end

    [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
        throw Error(fmt::format("ply line {}: expected {}, found {}", number, expected, shown(found)));
    }
};

std::string_view next_line(HeaderReader& reader) {
    ++reader.number;
    const std::size_t end = reader.text.find(reader.end_of_line, reader.at);
    if (end == std::string_view::npos) reader.fail("a header that ends with end_header", "");
    const std::string_view line = reader.text.substr(reader.at, end - reader.at);
    reader.at = end + reader.end_of_line.size();
    return line;
}

void read_magic(HeaderReader& reader) {
    reader.number = 1;
    const std::size_t end = reader.text.substr(0, 16).find_first_of("\r\n");
    if (!reader.text.starts_with("ply") || end == std::string_view::npos ||
        trimmed(reader.text.substr(3, end - 3)) != "")
        reader.fail("ply", reader.text.substr(0, 16));
    if (reader.text[end] == '\r') reader.end_of_line = reader.text.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
    reader.at = end + reader.end_of_line.size();
}

Encoding read_encoding(const HeaderReader& reader, Words& words) {
    const std::string_view name = words.next();
    const std::string_view version = words.next();
    if (version != "1.0") reader.fail("version 1.0", version);
    if (name == "ascii") return Encoding::ascii;
    if (name == "binary_little_endian") return Encoding::little;
    if (name == "binary_big_endian") return Encoding::big;
    reader.fail("ascii, binary_little_endian or binary_big_endian", name);
}

Element read_element(const HeaderReader& reader, Words& words) {
    Element element;
    element.name = words.next();
    const std::string_view word = words.next();
    const std::optional<std::int64_t> count = parse_integer(word);
    if (!count || *count < 0) reader.fail(fmt::format("the number of {}", shown(element.name)), word);
    element.count = static_cast<std::uint64_t>(*count);
    return element;
}

Type read_type(const HeaderReader& reader, std::string_view name) {
    for (const auto& [known, type] : type_names)
        if (known == name) return type;
    reader.fail("a type such as float or uchar", name);
}

Property read_property(const HeaderReader& reader, Words& words) {
    Property property;
    std::string_view word = words.next();
    if (word == "list") {
        property.list_count = read_type(reader, words.next());
        if (!is_integer(*property.list_count)) reader.fail("an integer type for the length of a list", "a float type");
        word = words.next();
    }
    property.type = read_type(reader, word);
    property.name = words.next();
    if (property.name.empty()) reader.fail("the name of a property", "");
    return property;
}

void read_header_line(const HeaderReader& reader, std::string_view keyword, Words& words, Header& header) {
    if (keyword == "element") {
        header.elements.push_back(read_element(reader, words));
    } else if (keyword == "property") {
        if (header.elements.empty()) reader.fail("an element before its first property", keyword);
        header.elements.back().properties.push_back(read_property(reader, words));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        reader.fail("element, property, comment or end_header", keyword);
    }
}

Header read_header(std::string_view text) {
    HeaderReader reader{text};
    read_magic(reader);
    Header header;
    std::optional<Encoding> encoding;
    for (;;) {
        Words words(next_line(reader));
        const std::string_view keyword = words.next();
        if (keyword == "end_header") break;
        if (keyword == "format") {
            encoding = read_encoding(reader, words);
        } else {
            read_header_line(reader, keyword, words, header);
        }
    }
    if (!encoding) reader.fail("a line with the format before end_header", "");
    header.encoding = *encoding;
    header.size = reader.at;
    return header;
}

// ---- body

struct Body {
    std::string_view text;  // the whole file
    Encoding encoding;
    std::size_t at;

    [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
        if (encoding != Encoding::ascii)
            throw Error(fmt::format("ply byte {}: expected {}, found {}", at, expected, found));
        const auto lines = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw Error(fmt::format("ply line {}: expected {}, found {}", lines, expected, found));
    }
    [[nodiscard]] std::size_t left() const { return text.size() - at; }
};

double read_word(Body& body, Type type) {
    Words words(body.text.substr(body.at));
    const std::string_view word = words.next();
    const std::optional<double> number = parse_double(word);
    if (!number || (is_integer(type) && std::floor(*number) != *number))
        body.fail(is_integer(type) ? "an integer" : "a number", shown(word));
    body.at += words.position();
    return *number;
}

std::uint64_t load(const Body& body, std::size_t size) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t byte = body.encoding == Encoding::big ? i : size - 1 - i;
        bits = bits << 8U | static_cast<unsigned char>(body.text[body.at + byte]);
    }
    return bits;
}

double as_number(std::uint64_t bits, Type type) {
    switch (type) {
        case Type::int8:
            return static_cast<std::int8_t>(bits);
        case Type::int16:
            return static_cast<std::int16_t>(bits);
        case Type::int32:
            return static_cast<std::int32_t>(bits);
        case Type::float32:
            return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        case Type::float64:
            return std::bit_cast<double>(bits);
        default:
            return static_cast<double>(bits);
    }
}

double read_scalar(Body& body, Type type) {
    if (body.encoding == Encoding::ascii) return read_word(body, type);
    const std::size_t size = size_of(type);
    if (body.left() < size) body.fail("more data", "the end of the file");
    const double number = as_number(load(body, size), type);
    body.at += size;
    return number;
}

// The length of a list, which the bytes left can hold.
std::size_t read_length(Body& body, const Property& property) {
    const double length = read_scalar(body, *property.list_count);
    const std::size_t least = body.encoding == Encoding::ascii ? 2 : size_of(property.type);  // a blank and a digit
    const std::size_t most = body.left() / least;
    if (!(length >= 0 && length <= static_cast<double>(most)))
        body.fail(fmt::format("a list of at most {} entries", most), fmt::format("{}", length));
    return static_cast<std::size_t>(length);
}

void skip(Body& body, const Property& property) {
    const std::size_t length = property.list_count ? read_length(body, property) : 1;
    for (std::size_t i = 0; i < length; ++i) read_scalar(body, property.type);
}

float coordinate(Body& body, Type type) {
    const double number = read_scalar(body, type);
    if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max())))
        body.fail("a finite coordinate", fmt::format("{}", number));
    return static_cast<float>(number);
}

void read_vertex(Body& body, const Element& element, Mesh& mesh) {
    Vec3f position;
    for (const Property& property : element.properties) {
        if (property.name == "x") {
            position.x = coordinate(body, property.type);
        } else if (property.name == "y") {
            position.y = coordinate(body, property.type);
        } else if (property.name == "z") {
            position.z = coordinate(body, property.type);
        } else {
            skip(body, property);
        }
    }
    mesh.positions.push_back(position);
}

bool is_face_list(const Property& property) {
    return property.name == "vertex_indices" || property.name == "vertex_index";
}

// Lists of fewer than three corners have no surface and are passed over.
void read_corners(Body& body, const Property& property, Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    std::vector<std::uint32_t> corners(read_length(body, property));
    for (std::uint32_t& corner : corners) {
        const double index = read_scalar(body, property.type);
        if (!(index >= 0 && index < static_cast<double>(vertices)))
            body.fail(fmt::format("a vertex index from 0, below {}", vertices), fmt::format("{}", index));
        corner = static_cast<std::uint32_t>(index);
    }
    if (corners.size() >= 3) add_face(mesh, corners);
}

void read_face(Body& body, const Element& element, Mesh& mesh) {
    for (const Property& property : element.properties) {
        if (is_face_list(property)) {
            read_corners(body, property, mesh);
        } else {
            skip(body, property);
        }
    }
}

void read_record(Body& body, const Element& element, Mesh& mesh) {
    if (element.name == "vertex") return read_vertex(body, element, mesh);
    if (element.name == "face") return read_face(body, element, mesh);
    for (const Property& property : element.properties) skip(body, property);
}

// ---- what the header has to promise

std::size_t properties_named(const Element& element, std::string_view name, bool list) {
    std::size_t found = 0;
    for (const Property& p : element.properties) found += p.name == name && p.list_count.has_value() == list ? 1 : 0;
    return found;
}

void check_vertex(const Element& element) {
    for (const std::string_view name : {"x", "y", "z"})
        if (properties_named(element, name, false) != 1 || properties_named(element, name, true) != 0)
            throw Error(fmt::format("ply header: expected one property {} of the element vertex, found {}", name,
                                    properties_named(element, name, false)));
}

void check_face(const Element& element) {
    std::size_t lists = 0;
    bool integers = true;
    for (const Property& property : element.properties) {
        if (!is_face_list(property)) continue;
        ++lists;
        integers = integers && property.list_count && is_integer(property.type);
    }
    if (lists != 1 || !integers)
        throw Error(fmt::format("ply header: expected one integer list vertex_indices of the element face, found {}",
                                lists == 1 ? "another type" : fmt::format("{}", lists)));
    if (element.count == 0) throw Error("ply header: expected faces, found a count of 0");
}

// Vertices once, then faces once: an index can be checked as it is read.
void check_elements(const Header& header) {
    std::size_t vertices = 0, faces = 0;
    for (const Element& element : header.elements) {
        if (element.name == "vertex") {
            check_vertex(element);
            ++vertices;
        }
        if (element.name != "face") continue;
        check_face(element);
        ++faces;
        if (vertices == 0) throw Error("ply header: expected the element vertex before face, found face first");
    }
    if (vertices != 1 || faces != 1)
        throw Error(
            fmt::format("ply header: expected one element vertex and one face, found {} and {}", vertices, faces));
}

// Each record takes a byte at least, so the count bounds the work by the size of the file.
void read_records(Body& body, const Element& element, Mesh& mesh) {
    if (element.properties.empty()) return;
    if (element.count > body.left())
        body.fail(fmt::format("at most {} records of {} in the bytes left", body.left(), shown(element.name)),
                  fmt::format("a count of {}", element.count));
    for (std::uint64_t i = 0; i < element.count; ++i) read_record(body, element, mesh);
}

}  // namespace

Mesh parse_ply(std::span<const std::byte> bytes) {
    check_size(bytes, "ply");
    const Header header = read_header(as_text(bytes));
    check_elements(header);
    Body body{as_text(bytes), header.encoding, header.size};
    Mesh mesh;
    for (const Element& element : header.elements) read_records(body, element, mesh);
    if (body.encoding == Encoding::ascii && !trimmed(body.text.substr(body.at)).empty())
        body.fail("the end of the file", shown(trimmed(body.text.substr(body.at))));
    return mesh;
}

}  // namespace mien
