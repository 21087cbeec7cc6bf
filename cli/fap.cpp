// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fap_files.hpp"
#include "outputs.hpp"
#include "parts.hpp"

#include "mien/algorithms/fap_filters.hpp"

namespace mien::cli {

namespace {

using Streams = std::vector<FapStream>;

// What every filter has: streams that come in, and one that goes out.
struct Filter {
    std::vector<std::filesystem::path> inputs;
    FapOutput output;
};

Streams load_all(const std::vector<std::filesystem::path>& files, Report& report) {
    Streams streams;
    for (const std::filesystem::path& file : files) {
        Report about;
        streams.push_back(load_faps(file, about));
        if (about.contains("warnings"))
            for (const Report& sentence : about["warnings"]) warn(report, sentence.get<std::string>());
        report["faps"].push_back(about["faps"]);
    }
    return streams;
}

using Work = std::function<FapStream(const Streams&)>;

void filter(Call& call, const Filter& flags, const Work& work) {
    check_output(flags.output.output, flags.inputs, call.flags);
    const FapStream result = work(load_all(flags.inputs, call.report));
    call.report["result"] = {{"frames", result.frames.size()}, {"frames_per_second", result.rate}};
    write_faps(call, flags.output, result);
}

// A filter of so many streams, at most as many.
CLI::App* add_filter(CLI::App& verbs, Call& call, const std::string& name, const std::string& purpose,
                     const std::string& example, std::pair<int, int> streams, Work work) {
    const auto flags = std::make_shared<Filter>();
    CLI::App* verb = add_verb(verbs, call, name, purpose, example,
                              [&call, flags, work = std::move(work)] { filter(call, *flags, work); });
    verb->add_option("faps", flags->inputs, "parameters: .fap .fba")
        ->required()
        ->expected(streams.first, streams.second);
    add_fap_output_flags(*verb, flags->output);
    return verb;
}

void add_retime(CLI::App& verbs, Call& call) {
    const auto options = std::make_shared<RetimeOptions>();
    CLI::App* verb = add_filter(verbs, call, "retime", "Plays faster, slower or at another rate.",
                                "mien fap retime smile.fap --speed 1.5 --rate 30 -o quick.fap", {1, 1},
                                [options](const Streams& streams) { return retimed(streams[0], *options); });
    verb->add_option("--speed", options->speed, "2 takes half of the time")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verb->add_option("--rate", options->rate, "frames per second; 0: as before")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
}

void add_scale(CLI::App& verbs, Call& call) {
    const auto strengths = std::make_shared<std::vector<std::string>>();
    CLI::App* verb =
        add_filter(verbs, call, "scale", "Moves parts of the face more or less.",
                   "mien fap scale smile.fap --strength mouth=1.2,brows=0.5 -o wider.fap", {1, 1},
                   [strengths](const Streams& streams) { return scaled(streams[0], part_strengths(*strengths)); });
    add_strength_flag(*verb, *strengths, "regions, head, points or parameters, by commas: mouth=1.2,open_jaw=0.5")
        ->required();
}

void add_blend(CLI::App& verbs, Call& call) {
    const auto share = std::make_shared<double>(0.5);
    CLI::App* verb = add_filter(verbs, call, "blend", "Plays two performances at once.",
                                "mien fap blend smile.fap talk.fap --share 0.5 -o both.fap", {2, 2},
                                [share](const Streams& streams) { return blended(streams[0], streams[1], *share); });
    verb->add_option("--share", *share, "of the second one: 0 is the first alone, 1 the second")->capture_default_str();
}

Report rows_of(const FapStream& stream) {
    Report rows = Report::array();
    for (const FapStatistics& row : statistics(stream))
        rows.push_back({{"fap", row.fap},
                        {"name", fap_info(row.fap).name},
                        {"frames", row.frames},
                        {"low", row.low},
                        {"high", row.high},
                        {"mean", row.mean},
                        {"deviation", row.deviation},
                        {"outside", row.outside},
                        {"negative", row.negative}});
    return rows;
}

void add_statistics(CLI::App& verbs, Call& call) {
    const auto file = std::make_shared<std::filesystem::path>();
    CLI::App* verb = add_verb(verbs, call, "statistics", "Says what a stream does with each parameter.",
                              "mien fap statistics smile.fap", [&call, file] {
                                  const FapStream stream = load_faps(*file, call.report);
                                  call.report["statistics"] = rows_of(stream);
                              });
    verb->add_option("faps", *file, "the parameters: .fap .fba")->required();
}

}  // namespace

void add_fap(CLI::App& app, Call& call) {
    CLI::App* verbs = app.add_subcommand("fap", "Changes and measures face animation parameters.");
    verbs->require_subcommand(1);
    verbs->footer("Example:\n  mien fap mirror smile.fap -o other-side.fap");
    add_filter(*verbs, call, "mirror", "Swaps the sides of the face.", "mien fap mirror smile.fap -o other-side.fap",
               {1, 1}, [](const Streams& streams) { return mirrored(streams[0]); });
    add_retime(*verbs, call);
    add_scale(*verbs, call);
    add_filter(*verbs, call, "join", "Plays one stream after the other.",
               "mien fap join hello.fap smile.fap -o both.fap", {2, 1000},
               [](const Streams& streams) { return concatenated(streams); });
    add_blend(*verbs, call);
    add_statistics(*verbs, call);
}

}  // namespace mien::cli
