// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "fap_files.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <span>
#include <string>
#include <vector>

#include "outputs.hpp"

#include "mien/algorithms/fap_filters.hpp"
#include "mien/io/fap_text.hpp"
#include "mien/io/read.hpp"

namespace mien::cli {

namespace {

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

std::string check_extension(const std::string& name) {
    if (is_faps(name)) return {};
    return "expected .fap (text) or .fba (bitstream), found " + name;
}

std::vector<std::byte> bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

bool is_faps(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return extension == ".fap" || extension == ".fba";
}

FapStream load_faps(const std::filesystem::path& file, Report& report) {
    const DecodedFaps decoded = read_faps(file);
    const FapStream& stream = decoded.stream;
    FapMask sent;
    for (const FapFrame& frame : stream.frames) sent |= frame.mask;
    Report& about = report["faps"];
    about["file"] = file.filename().string();
    about["frames"] = stream.frames.size();
    about["frames_per_second"] = stream.rate;
    about["parameters"] = sent.count();
    if (!decoded.cut.empty()) warn(report, fmt::format("{}: the stream is cut: {}", file.string(), decoded.cut));
    return decoded.stream;
}

bool is_fdp(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    return extension == ".fat" || extension == ".bt" || extension == ".fdp" || extension == ".fapu" ||
           extension == ".json";
}

void add_fdp_flags(CLI::App& verb, FdpFlags& flags) {
    verb.add_option("--displacements", flags.displacements,
                    "what the displacements of a .fat or .bt count: units of the FAP, or lengths of the model")
        ->check(CLI::IsMember({"units", "lengths"}))
        ->capture_default_str();
    verb.add_option("--below-zero", flags.below_zero,
                    "what they are multiplied by below zero: the signed value, or the way downward")
        ->check(CLI::IsMember({"signed", "downward"}))
        ->capture_default_str();
}

FdpTextOptions fdp_options(const FdpFlags& flags) {
    return {flags.displacements == "units", flags.below_zero == "downward"};
}

namespace {

Report table_report(const FaceDefTables& table, const Fat& fat) {
    Report about{{"fap", table.fap}, {"name", fap_info(table.fap).name}};
    if (table.high_level_select > 0) about["select"] = table.high_level_select;
    for (const FaceDefMesh& mesh : table.meshes) {
        about["vertices"] = about.value("vertices", std::size_t{0}) + mesh.vertices.size();
        about["borders"].push_back(mesh.borders);
    }
    for (const FaceDefTransform& transform : table.transforms) about["nodes"].push_back(fat.nodes[transform.node].name);
    return about;
}

}  // namespace

void report_fdp(const Fdp& fdp, Report& report) {
    for (const FeaturePoint& point : fdp.points) report["feature_points"].push_back(point.id);
    const Fapu& fapu = fdp.fapu;
    if (fapu.irisd > 0 || fapu.es > 0 || fapu.ens > 0 || fapu.mns > 0 || fapu.mw > 0)
        report["units"] = {
            {"irisd", fapu.irisd}, {"es", fapu.es}, {"ens", fapu.ens}, {"mns", fapu.mns}, {"mw", fapu.mw}};
    for (const FatNode& node : fdp.fat.nodes)
        report["nodes"].push_back({{"name", node.name}, {"vertices", node.vertices.size()}});
    for (const FaceDefTables& table : fdp.fat.tables) report["parameters"].push_back(table_report(table, fdp.fat));
}

void add_fap_output_flags(CLI::App& verb, FapOutput& flags) {
    verb.add_option("-o,--output", flags.output, "what to write: .fap (text) or .fba (bitstream)")
        ->required()
        ->check(CLI::Validator(check_extension, ""));
    verb.add_option("--quant", flags.stream.quant,
                    "how coarse a bitstream is: steps of the standard's table in a level; 0 keeps values as they are")
        ->check(CLI::Range(0, 31))
        ->capture_default_str();
    verb.add_option("--bitrate", flags.stream.kilobits_per_second,
                    "kilobits per second that a bitstream keeps to, with the finest levels from --quant on that do")
        ->check(CLI::PositiveNumber);
    verb.add_option("--intra-every", flags.stream.intra_every,
                    "frames after which a bitstream can be entered again; 0: only where it has to")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
}

void write_faps(Call& call, const FapOutput& flags, const FapStream& stream) {
    if (extension_of(flags.output) == ".fap") {
        write_output(call, flags.output, bytes_of(format_fap_text(stream)));
        return;
    }
    const EncodedFaps encoded = format_fba(stream, flags.stream);
    Report& about = call.report["bitstream"];
    about["quantiser"] = encoded.quant;
    about["kilobits_per_second"] = encoded.kilobits_per_second;
    about["values_clamped"] = encoded.clamped;
    if (encoded.clamped > 0)
        warn(call.report, fmt::format("{} values lay beyond what quantiser {} reaches and were moved to its end",
                                      encoded.clamped, encoded.quant));
    write_output(call, flags.output, bytes_of(encoded.bytes));
}

}  // namespace mien::cli
