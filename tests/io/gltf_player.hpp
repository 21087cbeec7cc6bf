// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A small glTF player for tests, written from the specification (3.6.2, 3.7.3, 3.11, appendix C) and sharing nothing
// with what it judges but the container: it shows where every vertex of a file is at a time, as a viewer would.

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "io/glb.hpp"

#include "mien/vec.hpp"

namespace mien::played {

using nlohmann::json;
using Numbers = std::vector<std::vector<double>>;  ///< elements of an accessor, each with its components

class Player {
public:
    explicit Player(std::span<const std::byte> bytes) : document_(parse_glb(bytes)) {}
    explicit Player(GltfDocument document) : document_(std::move(document)) {}

    [[nodiscard]] const json& root() const { return document_.json; }

    /// The elements of accessor `index`; normalised integers as numbers from -1 to 1.
    [[nodiscard]] Numbers accessor(std::size_t index) const {
        const json& accessor = root().at("accessors").at(index);
        const std::size_t width =
            std::map<std::string, std::size_t>{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}.at(
                accessor.at("type"));
        const std::size_t count = accessor.at("count");
        Numbers numbers(count, std::vector<double>(width, 0.0));
        if (accessor.contains("bufferView"))
            for (std::size_t i = 0; i < count; ++i)
                numbers[i] = element(accessor, accessor.at("componentType"), width, i);
        if (accessor.contains("sparse")) replace(numbers, accessor.at("sparse"), accessor.at("componentType"), width);
        return numbers;
    }

    /// Where every vertex of every mesh on a node is at `time`: nodes in their order, then primitives, then vertices.
    [[nodiscard]] std::vector<Vec3> positions(double time) const {
        const json nodes = posed(time);
        std::vector<Vec3> result;
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            if (!nodes[n].contains("mesh")) continue;
            const std::size_t mesh = nodes[n].at("mesh");
            for (std::size_t p = 0; p < root().at("meshes").at(mesh).at("primitives").size(); ++p)
                show(nodes, {mesh, p, n}, result);
        }
        return result;
    }

    /// A primitive of a mesh as one node shows it.
    struct Shown {
        std::size_t mesh = 0, primitive = 0, node = 0;
        std::size_t number = 0;  ///< the mesh's, or for one that is shown again the next one behind all of the file
    };

    /// What the document's scene shows: meshes and their primitives on the first node that shows them, depth first;
    /// then what is shown again, in that order.
    [[nodiscard]] std::vector<Shown> shown() const {
        std::vector<std::size_t> open, traversal;
        const json& scene = root().at("scenes").at(root().value("scene", std::size_t{0}));
        for (const json& node : scene.value("nodes", json::array())) open.push_back(node);
        std::reverse(open.begin(), open.end());
        while (!open.empty()) {
            traversal.push_back(open.back());
            open.pop_back();
            const json children = root().at("nodes").at(traversal.back()).value("children", json::array());
            open.insert(open.end(), children.rbegin(), children.rend());
        }
        std::vector<Shown> all;
        const std::size_t meshes = root().value("meshes", json::array()).size();
        const auto add = [&](std::size_t mesh, std::size_t node, std::size_t number) {
            for (std::size_t p = 0; p < root()["meshes"][mesh].at("primitives").size(); ++p)
                all.push_back({mesh, p, node, number});
        };
        const auto shows = [&](std::size_t node, std::size_t mesh) {
            return root()["nodes"][node].value("mesh", json()) == mesh;
        };
        std::vector<std::size_t> again;
        for (std::size_t mesh = 0; mesh < meshes; ++mesh) {
            const auto first =
                std::find_if(traversal.begin(), traversal.end(), [&](std::size_t node) { return shows(node, mesh); });
            if (first != traversal.end()) add(mesh, *first, mesh);
            for (auto node = first; node != traversal.end(); ++node)
                if (node != first && shows(*node, mesh)) again.push_back(*node);
        }
        std::size_t number = meshes;
        for (const std::size_t node : traversal)
            if (std::find(again.begin(), again.end(), node) != again.end())
                add(root()["nodes"][node].at("mesh").get<std::size_t>(), node, number++);
        return all;
    }

    /// Where the vertices of each of these are at `time`.
    [[nodiscard]] std::vector<std::vector<Vec3>> positions(const std::vector<Shown>& all, double time) const {
        const json nodes = posed(time);
        std::vector<std::vector<Vec3>> result;
        for (const Shown& what : all) show(nodes, what, result.emplace_back());
        return result;
    }

    /// The last key time of the first animation; 0 without any.
    [[nodiscard]] double duration() const {
        double last = 0;
        for (const json& channel : animation().value("channels", json::array()))
            last = std::max(last, accessor(sampler_of(channel).at("input")).back()[0]);
        return last;
    }

private:
    // A viewer plays one animation: the first.
    [[nodiscard]] json animation() const {
        const json animations = root().value("animations", json::array());
        return animations.empty() ? json::object() : animations[0];
    }
    [[nodiscard]] const json& sampler_of(const json& channel) const {
        return root().at("animations")[0].at("samplers").at(channel.at("sampler").get<std::size_t>());
    }

    static std::size_t size_of(int component) {
        if (component == 5120 || component == 5121) return 1;
        return component == 5122 || component == 5123 ? 2 : 4;
    }

    template <class T>
    static double number(const std::byte* at) {
        T value{};
        std::memcpy(&value, at, sizeof value);
        return static_cast<double>(value);
    }

    [[nodiscard]] std::vector<double> element(const json& place, int component, std::size_t width,
                                              std::size_t i) const {
        const json& view = root().at("bufferViews").at(place.at("bufferView").get<std::size_t>());
        const std::size_t size = size_of(component);
        const std::size_t stride = view.value("byteStride", size * width);
        const std::size_t inside = place.value("byteOffset", std::size_t{0}) + i * stride;
        EXPECT_LE(inside + size * width, view.at("byteLength").get<std::size_t>());
        const std::byte* at = document_.binary.data() + view.value("byteOffset", std::size_t{0}) + inside;
        std::vector<double> values;
        for (std::size_t c = 0; c < width; ++c, at += size) {
            const bool normalized = place.value("normalized", false);
            switch (component) {
                case 5120:
                    values.push_back(normalized ? std::max(number<std::int8_t>(at) / 127, -1.0)
                                                : number<std::int8_t>(at));
                    break;
                case 5121:
                    values.push_back(number<std::uint8_t>(at) / (normalized ? 255 : 1));
                    break;
                case 5122:
                    values.push_back(normalized ? std::max(number<std::int16_t>(at) / 32767, -1.0)
                                                : number<std::int16_t>(at));
                    break;
                case 5123:
                    values.push_back(number<std::uint16_t>(at) / (normalized ? 65535 : 1));
                    break;
                case 5125:
                    values.push_back(number<std::uint32_t>(at));
                    break;
                default:
                    values.push_back(number<float>(at));
            }
        }
        return values;
    }

    void replace(Numbers& numbers, const json& sparse, int component, std::size_t width) const {
        const json& indices = sparse.at("indices");
        double before = -1;
        for (std::size_t i = 0; i < sparse.at("count").get<std::size_t>(); ++i) {
            const double at = element(indices, indices.at("componentType"), 1, i)[0];
            EXPECT_GT(at, before) << "sparse indices ascend";
            before = at;
            numbers.at(static_cast<std::size_t>(at)) = element(sparse.at("values"), component, width, i);
        }
    }

    // The values of a sampler at a time (appendix C).
    [[nodiscard]] std::vector<double> sampled(const json& sampler, double time, bool turns) const {
        const std::string between = sampler.value("interpolation", "LINEAR");
        const Numbers times = accessor(sampler.at("input"));
        const Numbers flat = accessor(sampler.at("output"));
        const std::size_t per_key = flat.size() / times.size();
        // All numbers of key k; of a cubic one only the tangent in, the value or the tangent out.
        const auto key = [&](std::size_t k, std::size_t third = 1) {
            const std::size_t size = between == "CUBICSPLINE" ? per_key / 3 : per_key;
            const std::size_t first = k * per_key + (between == "CUBICSPLINE" ? third * size : 0);
            std::vector<double> values;
            for (std::size_t i = first; i < first + size; ++i)
                values.insert(values.end(), flat[i].begin(), flat[i].end());
            return values;
        };
        if (time <= times.front()[0]) return key(0);
        if (time >= times.back()[0]) return key(times.size() - 1);
        std::size_t k = 0;
        while (times[k + 1][0] <= time) ++k;
        const double span = times[k + 1][0] - times[k][0], share = (time - times[k][0]) / span;
        std::vector<double> a = key(k);
        const std::vector<double> b = key(k + 1);
        if (between == "STEP") return a;
        if (between == "CUBICSPLINE") return cubic(a, b, key(k, 2), key(k + 1, 0), share, span);
        if (turns) {
            const Eigen::Quaterniond from(a[3], a[0], a[1], a[2]), to(b[3], b[0], b[1], b[2]);
            const Eigen::Quaterniond middle = from.slerp(share, to);
            return {middle.x(), middle.y(), middle.z(), middle.w()};
        }
        for (std::size_t i = 0; i < a.size(); ++i) a[i] += share * (b[i] - a[i]);
        return a;
    }

    // Bezier's form of the cubic that runs from a to b with these slopes.
    static std::vector<double> cubic(const std::vector<double>& a, const std::vector<double>& b,
                                     const std::vector<double>& out_of_a, const std::vector<double>& into_b,
                                     double share, double span) {
        std::vector<double> result;
        const auto mix = [&](double p, double q) { return p + share * (q - p); };
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double p = a[i] + span / 3 * out_of_a[i], q = b[i] - span / 3 * into_b[i];
            const double ap = mix(a[i], p), pq = mix(p, q), qb = mix(q, b[i]);
            result.push_back(mix(mix(ap, pq), mix(pq, qb)));
        }
        return result;
    }

    // The nodes with the animation's values at a time written into them.
    [[nodiscard]] json posed(double time) const {
        json nodes = root().at("nodes");
        for (const json& channel : animation().value("channels", json::array())) {
            const std::string path = channel.at("target").at("path");
            nodes.at(channel.at("target").at("node").get<std::size_t>())[path] =
                sampled(sampler_of(channel), time, path == "rotation");
        }
        return nodes;
    }

    static Eigen::Affine3d local(const json& node) {
        const std::vector<double> t = node.value("translation", std::vector<double>{0, 0, 0});
        const std::vector<double> r = node.value("rotation", std::vector<double>{0, 0, 0, 1});
        const std::vector<double> s = node.value("scale", std::vector<double>{1, 1, 1});
        if (node.contains("matrix")) {
            const std::vector<double> m = node.at("matrix");
            return Eigen::Affine3d(Eigen::Map<const Eigen::Matrix4d>(m.data()));
        }
        return Eigen::Translation3d(t[0], t[1], t[2]) * Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized() *
               Eigen::Scaling(s[0], s[1], s[2]);
    }

    static Eigen::Affine3d global(const json& nodes, std::size_t node) {
        for (std::size_t parent = 0; parent < nodes.size(); ++parent)
            for (const json& child : nodes[parent].value("children", json::array()))
                if (child == node) return global(nodes, parent) * local(nodes[node]);
        return local(nodes[node]);
    }

    static Eigen::Vector3d vector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

    // Morph targets first, then the skin (or the node where there is none), as the specification says.
    void show(const json& nodes, const Shown& what, std::vector<Vec3>& result) const {
        const std::size_t node = what.node;
        const json& mesh = root().at("meshes").at(what.mesh);
        const json& primitive = mesh.at("primitives").at(what.primitive);
        Numbers points = accessor(primitive.at("attributes").at("POSITION"));
        add_targets(nodes[node], mesh, primitive, points);
        std::vector<Eigen::Affine3d> palette;
        if (nodes[node].contains("skin") && primitive.at("attributes").contains("JOINTS_0"))
            palette = joint_matrices(nodes, nodes[node].at("skin"));
        const Eigen::Affine3d still = palette.empty() ? global(nodes, node) : Eigen::Affine3d::Identity();
        std::vector<std::pair<Numbers, Numbers>> sets;
        for (int s = 0; !palette.empty() && primitive.at("attributes").contains("JOINTS_" + std::to_string(s)); ++s)
            sets.emplace_back(accessor(primitive.at("attributes").at("JOINTS_" + std::to_string(s))),
                              accessor(primitive.at("attributes").at("WEIGHTS_" + std::to_string(s))));
        for (std::size_t v = 0; v < points.size(); ++v) {
            Eigen::Vector3d moved =
                palette.empty() ? Eigen::Vector3d(still * vector(points[v])) : Eigen::Vector3d(0, 0, 0);
            for (const auto& [joints, weights] : sets)
                for (std::size_t k = 0; k < 4; ++k)
                    moved += weights[v][k] * (palette.at(static_cast<std::size_t>(joints[v][k])) * vector(points[v]));
            result.push_back({moved.x(), moved.y(), moved.z()});
        }
    }

    void add_targets(const json& node, const json& mesh, const json& primitive, Numbers& points) const {
        const json targets = primitive.value("targets", json::array());
        std::vector<double> weights = mesh.value("weights", std::vector<double>(targets.size(), 0.0));
        weights = node.value("weights", weights);
        ASSERT_EQ(weights.size(), targets.size());
        for (std::size_t t = 0; t < targets.size(); ++t) {
            if (weights[t] == 0 || !targets[t].contains("POSITION")) continue;
            const Numbers deltas = accessor(targets[t].at("POSITION"));
            for (std::size_t v = 0; v < points.size(); ++v)
                for (std::size_t c = 0; c < 3; ++c) points[v][c] += weights[t] * deltas.at(v)[c];
        }
    }

    [[nodiscard]] std::vector<Eigen::Affine3d> joint_matrices(const json& nodes, std::size_t skin) const {
        const json& description = root().at("skins").at(skin);
        std::vector<Eigen::Affine3d> matrices;
        for (const json& joint : description.at("joints")) matrices.push_back(global(nodes, joint));
        if (!description.contains("inverseBindMatrices")) return matrices;
        const Numbers inverse = accessor(description["inverseBindMatrices"]);
        for (std::size_t j = 0; j < matrices.size(); ++j)
            matrices[j] = matrices[j] * Eigen::Affine3d(Eigen::Map<const Eigen::Matrix4d>(inverse.at(j).data()));
        return matrices;
    }

    GltfDocument document_;
};

/// The numbers of an accessor, one after the other.
inline std::vector<double> numbers(const GltfDocument& document, const json& index) {
    std::vector<double> flat;
    for (const std::vector<double>& element : Player(document).accessor(index))
        flat.insert(flat.end(), element.begin(), element.end());
    return flat;
}

/// The elements of an accessor of three numbers each.
inline std::vector<Vec3> vectors(const GltfDocument& document, const json& index) {
    std::vector<Vec3> result;
    for (const std::vector<double>& v : Player(document).accessor(index)) result.push_back({v.at(0), v.at(1), v.at(2)});
    return result;
}

}  // namespace mien::played
