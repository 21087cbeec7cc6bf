// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The prior of a rig in the extension MIEN_rig (docs/rig-file.md): the member "prior". A stiffness that is not positive
// definite would let the solve run away, so it is factorised before it is believed.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "io/gltf_json.hpp"
#include "io/rig_arrays.hpp"
#include "io/rig_extension.hpp"

namespace mien {

namespace {

using nlohmann::json;

const std::string prior_pointer = std::string(rig_pointer) + "/prior";

json append_shape(GltfDocument& document, const MorphTarget& shape) {
    json written = {{"name", shape.name}};
    written["vertices"] = append_array(document, shape.vertices);
    written["deltas"] = append_array(document, shape.deltas);
    return written;
}

// Vertices that turn with an eyeball, which no shape may move.
std::vector<bool> on_eyeballs(const Rig& rig) {
    std::vector<bool> turns(rig.rest.size(), false);
    for (const Eyeball& eyeball : rig.eyeballs)
        for (const std::uint32_t v : eyeball.vertices) turns[v] = true;
    return turns;
}

void check_shape(const MorphTarget& shape, const std::vector<bool>& turns, const std::string& pointer) {
    if (shape.deltas.size() != shape.vertices.size())
        fail_at(pointer + "/deltas/count", fmt::format("{}", shape.vertices.size()),
                fmt::format("{}", shape.deltas.size()));
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        const std::uint32_t v = shape.vertices[i];
        const auto fail = [&](std::string_view expected) {
            fail_at(pointer + "/vertices", expected, fmt::format("{} in element {}", v, i));
        };
        if (v >= turns.size()) fail(fmt::format("vertices below {}", turns.size()));
        if (i > 0 && shape.vertices[i - 1] >= v) fail("vertices that rise");
        if (turns[v]) fail("vertices of no eyeball");
    }
    const auto bad = std::find_if_not(shape.deltas.begin(), shape.deltas.end(), is_finite<float>);
    if (bad != shape.deltas.end())
        fail_at(pointer + "/deltas", "finite numbers",
                fmt::format("another in element {}", bad - shape.deltas.begin()));
}

std::vector<MorphTarget> read_shapes(const GltfDocument& document, const json& prior, const Rig& rig) {
    const json& written = array_member(prior, "shapes", prior_pointer);
    const std::string place = prior_pointer + "/shapes";
    if (written.size() > Prior::most_shapes)
        fail_at(place, fmt::format("at most {} shapes", Prior::most_shapes), fmt::format("{}", written.size()));
    const std::vector<bool> turns = on_eyeballs(rig);
    std::vector<MorphTarget> shapes;
    std::size_t bytes = 0;
    for (std::size_t k = 0; k < written.size(); ++k) {
        const std::string pointer = fmt::format("{}/{}", place, k);
        MorphTarget shape{text_member(written[k], "name", pointer), {}, {}};
        shape.vertices = read_array<std::uint32_t>(document, written[k], "vertices", pointer);
        shape.deltas = read_array<Vec3f>(document, written[k], "deltas", pointer);
        check_shape(shape, turns, pointer);
        // Many shapes that name one long view cannot fill the memory.
        bytes += shape.vertices.size() * (sizeof(std::uint32_t) + sizeof(Vec3f));
        if (bytes > document.binary.size()) fail_at(pointer, "numbers of its own", "those of another shape");
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

void check_response(const Prior& prior, std::size_t points) {
    const std::string place = prior_pointer + "/response";
    if (prior.response.size() != prior.shapes.size() * points)
        fail_at(place + "/count", fmt::format("{}", prior.shapes.size() * points),
                fmt::format("{}", prior.response.size()));
    const auto bad = std::find_if_not(prior.response.begin(), prior.response.end(), is_finite<double>);
    if (bad != prior.response.end())
        fail_at(place, "finite numbers", fmt::format("another in element {}", bad - prior.response.begin()));
}

// By the square roots of Cholesky, in place of `a`.
bool is_positive_definite(std::vector<double> a, std::size_t m) {
    for (std::size_t k = 0; k < m; ++k) {
        for (std::size_t i = k; i < m; ++i) {
            double sum = a[i * m + k];
            for (std::size_t j = 0; j < k; ++j) sum -= a[i * m + j] * a[k * m + j];
            if (i == k && !(sum > 0)) return false;
            a[i * m + k] = i == k ? std::sqrt(sum) : sum / a[k * m + k];
        }
        if (!std::isfinite(a[k * m + k])) return false;
    }
    return true;
}

void check_stiffness(const Prior& prior) {
    const std::string place = prior_pointer + "/stiffness";
    const std::vector<double>& H = prior.stiffness;
    const std::size_t m = prior.shapes.size();
    if (H.empty()) return;
    if (H.size() != m * m) fail_at(place + "/count", fmt::format("0 or {}", m * m), fmt::format("{}", H.size()));
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < m; ++j)
            if (!std::isfinite(H[i * m + j]) || H[i * m + j] != H[j * m + i])
                fail_at(place, "a symmetric matrix of finite numbers",
                        fmt::format("another at row {}, column {}", i, j));
    if (!is_positive_definite(H, m)) fail_at(place, "a positive definite matrix", "another");
}

}  // namespace

json append_prior(GltfDocument& document, const Prior& prior) {
    json written = {{"shapes", json::array()}};
    for (const MorphTarget& shape : prior.shapes) written["shapes"].push_back(append_shape(document, shape));
    written["response"] = append_array(document, prior.response);
    written["stiffness"] = append_array(document, prior.stiffness);
    return written;
}

Prior read_prior(const GltfDocument& document, const json& written, const Rig& rig) {
    Prior prior;
    prior.shapes = read_shapes(document, written, rig);
    prior.response = read_array<Vec3>(document, written, "response", prior_pointer);
    prior.stiffness = read_array<double>(document, written, "stiffness", prior_pointer);
    check_response(prior, rig.points.size());
    check_stiffness(prior);
    return prior;
}

}  // namespace mien
