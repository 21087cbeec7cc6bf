// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// From the table to the head, shape by shape: points by one linear map each (docs/methods.md), skin by the rig, then
// what has to be true of a shape whatever points say. Where this departs from the table:
//
// - jawOpen leaves the upper lip alone (shape_table.hpp).
// - mouthClose is not retargeted: contact would stop the lips of that motion alone, which cross. It is the difference
//   of two frames, jawOpen with mouthClose, in contact, less the jawOpen that is written.
// - Shapes of a symmetric head are averaged with their mirror images: then they are mirrors to the last bit.

#include "mien/algorithms/make_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

#include "algorithms/close_margins.hpp"
#include "algorithms/mirror_map.hpp"
#include "algorithms/shape_style.hpp"
#include "algorithms/shape_table.hpp"
#include "algorithms/tongue.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/upright.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

// The upper edge's share of the way that is left at first; then what is left between their vertices is shared alike.
constexpr double upper_lid_of_blink = 0.95, upper_lip_of_close = 0.3;
constexpr double least_delta = 1e-4;  // in eye distances: shorter ones are left out
constexpr double degrees = 3.14159265358979323846 / 180;

using Motions = std::vector<Vec3>;  // one per point of the rig
using Fields = std::map<std::string_view, ShapeField>;

struct Maker {
    const Face& face;
    const Rig& rig;
    const ShapesOptions& options;
    Weld weld;
    EdgeGraph graph;
    double eyes = 1;
    Quaternion turn;
    Vec3 origin;  // between the eyes
    Retarget with_contact, linear;
    std::vector<std::size_t> in_map;  // of each rig point: its number in the maps, or no_point
    Face driven;                      // with the points that the table knows; what the closer's margins count by
    MarginCloser closer;
    std::vector<PocketPlace> pockets;
    std::optional<MirrorMap> mirror;
    std::map<std::string_view, const MorphTarget*> examples;
    std::vector<MorphTarget> joined;  // examples that are the sum of two sides
    Style style;
};

// Where shapes are written, no lips are clamped; lids go their share of the way.
Retarget without_lips(Retarget map) {
    std::erase_if(map.pairs, [](const ContactPair& pair) { return pair.kind != ContactPair::Kind::lids; });
    return map;
}

Vec3 middle_of_eyes(const Maker& maker) {
    Vec3 sum;
    double count = 0;
    for (const FeaturePoint& point : maker.face.points)
        for (const char* id : {"3.7", "3.8", "3.11", "3.12"})
            if (point.id == id) sum += point.position, count += 1;
    if (count > 0) return sum / count;
    for (const Eyeball& eyeball : maker.rig.eyeballs) sum += eyeball.centre, count += 1;
    return count > 0 ? sum / count : maker.face.points.front().position;
}

// What a motion of the table's points is on this face: one displacement per point of the rig.
Motions onto_face(const Maker& maker, const Retarget& map, const Motions& motions) {
    std::vector<Vec3> source, target(map.points.size());
    for (std::size_t i = 0; i < motions.size(); ++i) source.push_back(map.source_neutral[i] + motions[i]);
    retarget(map, source, target);
    Motions result;
    for (const std::size_t i : maker.in_map)
        result.push_back(i == no_point ? Vec3{} : target[i] - map.target_neutral[i]);
    return result;
}

Motions at_points(const Maker& maker, const MorphTarget& shape) {
    Motions motions;
    for (const FeaturePoint& point : maker.rig.points) {
        const auto found = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), point.vertex);
        const bool moves = found != shape.vertices.end() && *found == point.vertex;
        motions.push_back(moves ? to_double(shape.deltas[static_cast<std::size_t>(found - shape.vertices.begin())])
                                : Vec3{});
    }
    return motions;
}

// The shape of the other side, mirrored, where the artist made that one.
std::optional<Motions> from_other_side(const Maker& maker, std::string_view shape) {
    const auto other = maker.examples.find(mirror_shape(shape));
    if (other == maker.examples.end()) return std::nullopt;
    const Vec3 across = rotate(maker.turn, {1, 0, 0});
    const Motions there = at_points(maker, *other->second);
    Motions here;
    for (const FeaturePoint& point : maker.rig.points) {
        const auto partner = find_point(maker.rig.points, mirror_point(point.id));
        if (!partner) return std::nullopt;
        here.push_back(there[*partner] - (2 * dot(across, there[*partner])) * across);
    }
    return here;
}

Motions plain_motions(const Maker& maker, std::string_view shape) {
    if (shape == "jawOpen") return onto_face(maker, maker.linear, jaw_open_motions(maker.with_contact.points));
    if (shape != "mouthClose") return onto_face(maker, maker.linear, table_motions(shape, maker.with_contact.points));
    Motions together = table_motions("jawOpen", maker.with_contact.points);
    const Motions close = table_motions("mouthClose", maker.with_contact.points);
    for (std::size_t i = 0; i < together.size(); ++i) together[i] += close[i];
    Motions result = onto_face(maker, maker.with_contact, together);
    const auto artist = maker.examples.find("jawOpen");
    const Motions open =
        artist == maker.examples.end() ? plain_motions(maker, "jawOpen") : at_points(maker, *artist->second);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] -= open[i];
    return result;
}

Motions point_motions(const Maker& maker, std::string_view shape) {
    if (maker.examples.empty()) return plain_motions(maker, shape);
    if (auto mirrored = from_other_side(maker, shape)) return *mirrored;
    if (shape == "mouthClose") return plain_motions(maker, shape);
    return styled(maker.style, plain_motions(maker, shape));
}

ShapeField spread(const Maker& maker, const Motions& motions) {
    std::vector<Vec3f> moves, positions(vertex_count(maker.rig));
    for (const Vec3& motion : motions) moves.push_back(to_float(motion));
    deform(maker.rig, moves, positions);
    ShapeField field;
    for (const std::uint32_t v : maker.weld.vertex)
        field.push_back(to_double(positions[v]) - to_double(maker.rig.rest[v]));
    return field;
}

ShapeField field_of(const Maker& maker, const MorphTarget& shape) {
    ShapeField field(maker.weld.vertex.size());
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
        field[maker.weld.place[shape.vertices[i]]] = to_double(shape.deltas[i]);
    return field;
}

// The turn of an eye that looks that way: in the face's own axes.
std::optional<Quaternion> gaze(const ShapesOptions& options, std::string_view shape, bool left) {
    if (!shape.starts_with("eyeLook") || shape.ends_with("Left") != left) return std::nullopt;
    const auto about = [](const Vec3& axis, double angle) {
        const double half = angle * degrees / 2;
        return Quaternion{std::sin(half) * axis.x, std::sin(half) * axis.y, std::sin(half) * axis.z, std::cos(half)};
    };
    const Vec3 x{1, 0, 0}, y{0, 1, 0};
    if (shape.starts_with("eyeLookUp")) return about(x, -options.look_up);
    if (shape.starts_with("eyeLookDown")) return about(x, options.look_down);
    return about(y, shape.starts_with("eyeLookOut") == left ? options.look_aside : -options.look_aside);
}

void turn_eyeballs(const Maker& maker, std::string_view shape, ShapeField& field) {
    const Vec3 across = rotate(maker.turn, {1, 0, 0});
    for (const Eyeball& eyeball : maker.rig.eyeballs) {
        const auto turn = gaze(maker.options, shape, dot(across, eyeball.centre - maker.origin) > 0);
        if (!turn) continue;
        for (const std::uint32_t v : eyeball.vertices) {
            const Vec3 arm = to_double(maker.face.mesh.positions[v]) - eyeball.centre;
            const Vec3 in_face = rotate(conjugate(maker.turn), arm);
            field[maker.weld.place[v]] = rotate(maker.turn, rotate(*turn, in_face)) - arm;
        }
    }
}

void arch_lids(const Maker& maker, std::string_view shape, ShapeField& field) {
    for (std::size_t m = 0; m < maker.closer.margins.size(); ++m)
        if (maker.closer.margins[m].kind ==
            (shape.ends_with("Left") ? Margin::Kind::left_lids : Margin::Kind::right_lids))
            arch_edges(maker.closer, maker.driven, maker.weld, m, field);
}

void close_lids(const Maker& maker, std::string_view shape, ShapeField& field) {
    const bool left = shape == "eyeBlinkLeft";
    if (!left && shape != "eyeBlinkRight") return;
    const MarginCloser& closer = maker.closer;
    for (std::size_t m = 0; m < closer.margins.size(); ++m) {
        if (closer.margins[m].kind != (left ? Margin::Kind::left_lids : Margin::Kind::right_lids)) continue;
        for (const double upper : {upper_lid_of_blink, 0.5, 0.5, 0.5})
            close_margin(closer, maker.face, maker.weld, m, Closing::touch, upper, field);
        edges_before_eyeballs(closer.margins[m], maker.face, maker.weld, maker.rig, field);
        field = drawn_by_edges(closer, maker.weld, field);
    }
}

std::optional<Vec3> between_lips(const Face& face) {
    for (const auto& [upper, lower] : {std::pair{"2.2", "2.3"}, {"8.1", "8.2"}}) {
        const auto a = find_point(face.points, upper), b = find_point(face.points, lower);
        if (a && b) return 0.5 * (face.points[*a].position + face.points[*b].position);
    }
    return std::nullopt;
}

ShapeField make_field(const Maker& maker, std::string_view shape) {
    ShapeField field = spread(maker, point_motions(maker, shape));
    if (shape.starts_with("eye")) {
        arch_lids(maker, shape, field);
        close_lids(maker, shape, field);
        turn_eyeballs(maker, shape, field);
        keep_out_of_eyeballs(maker.face, maker.weld, maker.rig, field);
    }
    follow_edges(maker.pockets, field);
    const auto lips = between_lips(maker.face);
    if (shape == "tongueOut" && lips)
        put_out_tongue(maker.face, maker.weld, tongue_places(maker.face, maker.weld), maker.turn, *lips, field);
    return field;
}

// What is still open, or crosses, along the lips when the mouth closes from the open jaw goes into mouthClose.
void close_lips(const Maker& maker, Fields& fields) {
    ShapeField both = fields.at("jawOpen");
    ShapeField& close = fields.at("mouthClose");
    for (std::size_t p = 0; p < both.size(); ++p) both[p] += close[p];
    const ShapeField before = both;
    for (std::size_t m = 0; m < maker.closer.margins.size(); ++m)
        if (maker.closer.margins[m].kind == Margin::Kind::lips)
            for (const double upper : {upper_lip_of_close, 0.5, 0.5})
                close_margin(maker.closer, maker.face, maker.weld, m, Closing::as_at_rest, upper, both);
    for (std::size_t p = 0; p < both.size(); ++p) close[p] += both[p] - before[p];
}

// `field` as the mirror shows it; places without a counterpart keep what `otherwise` has.
ShapeField mirror_image(const MirrorMap& map, const ShapeField& field, const ShapeField& otherwise) {
    ShapeField image = otherwise;
    for (std::uint32_t p = 0; p < field.size(); ++p)
        if (map.partner[p] != no_partner) image[p] = mirrored(map, field[map.partner[p]]);
    return image;
}

// Left and right: the mean of one and the other's mirror image, and its mirror image. The same for shapes of both
// sides. Beside an artist's shape stands its mirror image.
void make_mirrors(const Maker& maker, Fields& fields) {
    const auto kept = [&](std::string_view shape) { return maker.examples.count(shape) > 0; };
    for (auto& [shape, field] : fields) {
        const std::string_view twin = mirror_shape(shape);
        if (twin.ends_with("Left") || (kept(shape) && kept(twin))) continue;
        ShapeField& other = fields.at(twin);
        const ShapeField image = mirror_image(*maker.mirror, other, field);
        if (kept(twin)) field = image;
        if (!kept(shape) && !kept(twin))
            for (std::size_t p = 0; p < field.size(); ++p) field[p] = 0.5 * (field[p] + image[p]);
        if (twin != shape && !kept(twin)) other = mirror_image(*maker.mirror, field, other);
    }
}

double gain_of(const ShapesOptions& options, std::string_view shape) {
    double gain = 1;
    for (const ShapeGain& dial : options.gains)
        if (dial.shape == shape) gain = dial.gain;
    return gain;
}

Fields arkit_fields(const Maker& maker) {
    Fields fields;
    for (const NamedShape& shape : named_shapes()) {
        if (shape.set != ShapeSet::arkit) continue;
        const auto example = maker.examples.find(shape.name);
        fields[shape.name] =
            example == maker.examples.end() ? make_field(maker, shape.name) : field_of(maker, *example->second);
    }
    if (maker.examples.count("mouthClose") == 0) close_lips(maker, fields);
    if (maker.mirror) make_mirrors(maker, fields);
    for (auto& [shape, field] : fields)
        if (const double gain = gain_of(maker.options, shape); gain != 1)
            for (Vec3& delta : field) delta = gain * delta;
    return fields;
}

ShapeField sum_of(const Maker& maker, const NamedShape& shape, const Fields& fields) {
    ShapeField field(maker.weld.vertex.size());
    const double gain = gain_of(maker.options, shape.name);
    for (const ShapePart& part : shape.parts) {
        // Both sides are added up first, in one order or the other the same: mirrors stay mirrors.
        const ShapeSides sides = sides_of(part.shape);
        const ShapeField& one = fields.at(sides.first);
        const ShapeField* const other = sides.second.empty() ? nullptr : &fields.at(sides.second);
        for (std::size_t p = 0; p < field.size(); ++p)
            field[p] += (gain * part.weight) * (other == nullptr ? one[p] : one[p] + (*other)[p]);
    }
    return field;
}

MorphTarget written(const Maker& maker, std::string_view name, const ShapeField& field) {
    MorphTarget shape{std::string(name), {}, {}};
    for (std::uint32_t v = 0; v < maker.weld.place.size(); ++v) {
        const Vec3& delta = field[maker.weld.place[v]];
        if (!(length(delta) > least_delta * maker.eyes)) continue;
        shape.vertices.push_back(v);
        shape.deltas.push_back(to_float(delta));
    }
    return shape;
}

// The examples by their standard names; the sides of a shape that the standard does not part are added up.
void sort_examples(Maker& maker, FaceShapes& made) {
    const std::vector<MorphTarget>& all = maker.options.examples;
    maker.joined.reserve(all.size());
    for (const MorphTarget& shape : all) {
        if (!shape.vertices.empty() && shape.vertices.back() >= vertex_count(maker.face.mesh))
            throw Error(fmt::format("shapes: example \"{}\": expected vertices below {}, found {}", shape.name,
                                    vertex_count(maker.face.mesh), shape.vertices.back()));
        if (const auto name = standard_shape(shape.name)) {
            maker.examples[*name] = &shape;
            continue;
        }
        const std::string stem = shape.name.substr(0, shape.name.size() - std::min<std::size_t>(2, shape.name.size()));
        const auto whole = standard_shape(stem);
        const auto other = std::find_if(all.begin(), all.end(), [&](const MorphTarget& s) {
            return shape.name.ends_with("_L") && s.name == stem + "_R";
        });
        if (!whole || other == all.end()) {
            if (!(whole && shape.name.ends_with("_R"))) made.unknown.push_back(shape.name);
            continue;
        }
        ShapeField sum = field_of(maker, shape);
        const ShapeField right = field_of(maker, *other);
        for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += right[p];
        maker.joined.push_back(written(maker, *whole, sum));
        maker.examples[*whole] = &maker.joined.back();
    }
    for (const auto& [name, shape] : maker.examples) made.kept.emplace_back(name);
}

void learn_style(Maker& maker) {
    std::vector<StylePair> pairs;
    for (const auto& [name, shape] : maker.examples)
        if (name != "mouthClose") pairs.push_back({plain_motions(maker, name), at_points(maker, *shape)});
    maker.style = fit_style(maker.rig.points, pairs, rotate(maker.turn, {1, 0, 0}));
}

void check(const Face& face, const Rig& rig, const ShapesOptions& options) {
    if (vertex_count(rig) != vertex_count(face.mesh))
        throw Error(fmt::format("shapes: expected a rig of the head's {} vertices, found one of {}",
                                vertex_count(face.mesh), vertex_count(rig)));
    for (const double angle : {options.look_aside, options.look_up, options.look_down})
        if (!(angle >= 0 && angle <= 60))
            throw Error(fmt::format("shapes: expected eyes that turn by 0 to 60 degrees, found {}", angle));
    for (const ShapeGain& dial : options.gains) {
        if (!std::isfinite(dial.gain))
            throw Error(fmt::format("shapes: expected a finite gain of {}, found {}", dial.shape, dial.gain));
        const auto all = named_shapes();
        if (std::none_of(all.begin(), all.end(), [&](const NamedShape& s) { return s.name == dial.shape; }))
            throw Error(
                fmt::format("shapes: expected the name of a shape of ARKit, Oculus or VRM to set its gain, "
                            "found {}",
                            dial.shape));
    }
}

Maker maker_of(const Face& face, const Rig& rig, const ShapesOptions& options) {
    Maker maker{face, rig, options, weld(face.mesh), {}, eye_distance(face.points), {}, {}, {}, {}, {}, {}, {}, {}, {},
                {},   {},  {}};
    maker.graph = edge_graph(face.mesh, maker.weld);
    maker.turn = face_turn(face.points).value_or(Quaternion{});
    maker.origin = middle_of_eyes(maker);
    RetargetOptions retargeting;
    retargeting.method = options.method;
    maker.with_contact = fit_retarget(neutral_take(face.points), face, retargeting);
    maker.linear = without_lips(maker.with_contact);
    for (const FeaturePoint& point : rig.points) {
        const auto& ids = maker.with_contact.points;
        const auto found = std::find(ids.begin(), ids.end(), point.id);
        maker.in_map.push_back(found == ids.end() ? no_point : static_cast<std::size_t>(found - ids.begin()));
    }
    maker.driven = with_points(face, shape_points(face));
    maker.closer = fit_margin_closer(maker.driven, maker.weld, maker.graph);
    maker.pockets = eye_pockets(face, maker.weld, maker.graph, maker.closer.margins);
    maker.mirror = mirror_map(face, maker.weld);
    return maker;
}

void note_what_is_missing(const Maker& maker, FaceShapes& made) {
    const auto has = [&](Margin::Kind kind) {
        return std::any_of(maker.closer.margins.begin(), maker.closer.margins.end(),
                           [&](const Margin& margin) { return margin.kind == kind; });
    };
    if (!has(Margin::Kind::left_lids) || !has(Margin::Kind::right_lids))
        made.notes.emplace_back(
            "the points do not name the edges of both pairs of lids (3.1 to 3.4 with the corners "
            "3.7, 3.8, 3.11, 3.12): a blink closes at the points only");
    if (!has(Margin::Kind::lips))
        made.notes.emplace_back(
            "the points do not name the edges of the lips (2.2 to 2.5), or there is no slit: the mouth closes at the "
            "points only");
    if (maker.rig.eyeballs.empty())
        made.notes.emplace_back("no eyeballs were found at the points of the eyes: only the lids follow the gaze");
    if (tongue_places(maker.face, maker.weld).empty()) made.notes.emplace_back("no tongue: tongueOut moves nothing");
}

}  // namespace

std::vector<std::string> shape_points(const Face& face) {
    std::vector<std::string> ids;
    for (const FeaturePoint& point : face.points)
        if (is_driven(point.id)) ids.push_back(point.id);
    return ids;
}

FaceShapes make_shapes(const Face& face, const Rig& rig, const ShapesOptions& options) {
    check(face, rig, options);
    FaceShapes made;
    Maker maker = maker_of(face, rig, options);
    sort_examples(maker, made);
    learn_style(maker);
    made.symmetric = maker.mirror.has_value();
    const Fields fields = arkit_fields(maker);
    for (const NamedShape& shape : named_shapes()) {
        if (std::find(options.sets.begin(), options.sets.end(), shape.set) == options.sets.end()) continue;
        const auto example = maker.examples.find(shape.name);
        if (example != maker.examples.end()) {
            made.shapes.push_back(*example->second);
            made.shapes.back().name = shape.name;
        } else {
            made.shapes.push_back(
                written(maker, shape.name,
                        shape.set == ShapeSet::arkit ? fields.at(shape.name) : sum_of(maker, shape, fields)));
        }
    }
    note_what_is_missing(maker, made);
    return made;
}

}  // namespace mien
