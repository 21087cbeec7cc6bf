// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The program `mien`: one verb per file. It converts and calls; what is computed is computed in the library.

#include <algorithm>
#include <iostream>
#include <new>
#include <span>
#include <tbb/global_control.h>
#include <thread>

#include "interrupt.hpp"
#include "verb.hpp"

#include "mien/error.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

void print(const Call& call) {
    if (call.flags.json)
        std::cout << as_json(call.report);
    else if (!call.flags.quiet && !call.text.empty())
        std::cout << call.text;
    else if (!call.flags.quiet)
        std::cout << as_lines(call.report, call.flags.verbose);
}

void write_report(const Call& call) {
    if (call.flags.report.empty() || call.flags.dry_run) return;
    const std::string text = as_json(call.report);
    WriteOptions options;
    options.overwrite = call.flags.force;
    write_file(call.flags.report, std::as_bytes(std::span(text)), options);
}

std::size_t threads(const Common& flags) {
    return flags.threads > 0 ? static_cast<std::size_t>(flags.threads)
                             : std::max(1U, std::thread::hardware_concurrency());
}

int run(int argc, char** argv) {
    CLI::App app{"mien: brings any face mesh to life from feature points"};
    app.set_version_flag("--version", MIEN_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Start with:\n"
        "  mien animate HEAD.glb --points POINTS.json --take TAKE.trc --map MARKERS.csv -o OUT.glb\n"
        "Exit status: 0 done, 1 bad input, 2 bad usage, 3 cannot read or write, 4 a quality gate was not met.");
    Call call;
    add_animate(app, call);
    add_inspect(app, call);
    add_points(app, call);
    add_rig(app, call);
    add_retarget(app, call);
    add_deform(app, call);
    add_render(app, call);
    add_faps(app, call);
    add_play(app, call);
    add_encode(app, call);
    add_decode(app, call);
    add_fap(app, call);
    add_morph(app, call);
    add_evaluate(app, call);
    add_shapes(app, call);
    add_fat(app, call);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }

    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads(call.flags));
    call.work();
    write_report(call);
    print(call);
    if (!call.gate.empty()) throw GateError(call.gate);
    return 0;
}

int fail(const std::string& sentence, int status) {
    std::cerr << "mien: " << sentence << "\n";
    return status;
}

}  // namespace

int guarded_run(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        return fail(error.what(), error.kind() == Error::Kind::access ? 3 : 1);
    } catch (const GateError& error) {
        return fail(error.what(), 4);
    } catch (const Interrupted& stop) {
        return fail(stop.what(), 130);
    } catch (const std::bad_alloc&) {
        return fail("there is not enough memory for this input", 1);
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
}

}  // namespace mien::cli

int main(int argc, char** argv) {
    return mien::cli::guarded_run(argc, argv);
}
