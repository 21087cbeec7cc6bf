// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Greedy choice of points. With A the face's points and all candidates, the sheet gives the field at every place from
// its values at A: x_v = W x_A, and the energy E of those values. Prior of the values: S = q R q with R the correlation
// that E^-1 gives and q the mobility of each site. A rig that has the points P guesses the rest r by
//
//     x_r = B x_P,  B = -E_rr^-1 E_rP
//
// and misses, summed over the skin with H = W' M W, the trace of H_rr (S_rr - B S_Pr - S_rP B' + B S_PP B').

#include "mien/algorithms/suggest_points.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>

#include "algorithms/face_check.hpp"
#include "algorithms/island.hpp"
#include "algorithms/laplacian.hpp"
#include "algorithms/refit.hpp"
#include "algorithms/sheet.hpp"
#include "algorithms/sites.hpp"

#include "mien/algorithms/attach.hpp"
#include "mien/algorithms/retarget.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double nearest_other = 0.08;  // in eye distances: nearer to a point, a site is that point
constexpr double farthest_skin = 0.35;  // in eye distances: farther from skin, the head does not have the site
constexpr std::size_t fewest_known = 4;

// Places of the head that a site may be put on.
struct Ground {
    const Face& face;
    Weld weld;
    std::vector<bool> solved;
    SheetSkin skin;
    std::vector<bool> open;  // solved and in no pocket
    double scale = 1;
};

Ground ground_of(const Face& face) {
    Ground ground{face, weld(face.mesh), {}, {}, {}, face_scale(face)};
    check_face(face, ground.weld);
    ground.solved = solved_places(face, ground.weld);
    ground.skin = sheet_skin(face, ground.weld, ground.solved, ground.scale);
    ground.open = ground.solved;
    for (const std::uint32_t p : ground.skin.pockets.places) ground.open[p] = false;
    return ground;
}

// The warp of space from the generic face to this one.
Retarget warp_to(const Face& face, const std::vector<Site>& sites) {
    Take generic;
    for (const Site& site : sites)
        if (find_point(face.points, site.id)) {
            generic.points.emplace_back(site.id);
            generic.samples.push_back(site.position);
        }
    if (generic.points.size() < fewest_known)
        throw Error(
            fmt::format("suggested points: expected at least {} MPEG-4 points of lips, lids, brows, nose, "
                        "cheeks or chin to go by, found {}",
                        fewest_known, generic.points.size()));
    generic.times = {0};
    RetargetOptions options;
    options.method = RetargetMethod::rbf;
    return fit_retarget(generic, face, options);
}

// The nearest open place of the skin.
std::optional<std::uint32_t> on_skin(const Ground& ground, const Vec3& wanted) {
    std::optional<std::uint32_t> nearest;
    double least = farthest_skin * ground.scale;
    for (std::uint32_t p = 0; p < ground.open.size(); ++p) {
        if (!ground.open[p]) continue;
        const double far = distance(position(ground.face.mesh, ground.weld, p), wanted);
        if (far >= least) continue;
        least = far;
        nearest = p;
    }
    return nearest;
}

struct Placed {
    Site site;
    FeaturePoint point;
};

bool is_near_any(const Vec3& at, std::span<const FeaturePoint> points, double least) {
    return std::any_of(points.begin(), points.end(),
                       [&](const FeaturePoint& point) { return distance(point.position, at) < least; });
}

// The sites that the face lacks, on its skin. A pair comes whole or not at all.
std::vector<Placed> candidates(const Ground& ground, const std::vector<Site>& sites) {
    const Face& face = ground.face;
    const Retarget warp = warp_to(face, sites);
    std::vector<Placed> placed;
    std::vector<FeaturePoint> taken = face.points;
    const auto try_place = [&](const Site& site) {
        if (find_point(face.points, site.id)) return false;
        const Vec3 wanted = retarget(warp, site.position);
        const auto place = on_skin(ground, wanted);
        if (!place) return false;
        const Vec3 at = position(face.mesh, ground.weld, *place);
        if (is_near_any(at, taken, nearest_other * ground.scale)) return false;
        placed.push_back({site, {std::string(site.id), ground.weld.vertex[*place], at, {}, distance(at, wanted)}});
        taken.push_back(placed.back().point);
        return true;
    };
    for (const Site& site : sites) {
        if (site.id > site.mirror) continue;  // its partner brings it
        const auto other = std::find_if(sites.begin(), sites.end(), [&](const Site& s) { return s.id == site.mirror; });
        const bool first = try_place(site);
        const bool second = site.mirror == site.id || find_point(face.points, site.mirror) || try_place(*other);
        if (first && !second) {
            placed.pop_back();
            taken.pop_back();
        }
    }
    return placed;
}

// How far a point of the face moves: as its site does, or not at all when it is an ear's or the hair's, or like the
// others when it is the user's own.
double mobility_of(const FeaturePoint& point, const std::vector<Site>& sites) {
    const auto found = std::find_if(sites.begin(), sites.end(), [&](const Site& s) { return s.id == point.id; });
    if (found != sites.end()) return found->mobility;
    if (!mirror_point(point.id).empty()) return 0;
    double sum = 0;
    for (const Site& site : sites) sum += site.mobility;
    return sum / static_cast<double>(sites.size());
}

using Columns = std::vector<Eigen::Index>;

// What the greedy choice needs to know about points and candidates together.
struct Model {
    Eigen::MatrixXd energy;  // E
    Eigen::MatrixXd prior;   // S
    Eigen::MatrixXd onto;    // H
    [[nodiscard]] double motion() const { return std::sqrt((onto.array() * prior.array()).sum()); }
};

// H: all vertices of the skin alike, as modellers put them where it matters.
Eigen::MatrixXd seen_by_all(const Ground& ground, const Sheet& sheet, const Movers& movers) {
    Eigen::VectorXd vertices = Eigen::VectorXd::Zero(std::ssize(ground.weld.vertex));
    for (const std::uint32_t p : ground.weld.place) vertices[p] = 1;
    const auto open = static_cast<Eigen::Index>(sheet.free.size() - ground.skin.pockets.places.size());
    const Eigen::VectorXd at_free = vertices(sheet.free).head(open);
    const auto weights = sheet.weights.topRows(open);
    Eigen::MatrixXd onto = weights.transpose() * at_free.asDiagonal() * weights;
    onto.diagonal() += vertices(movers.places);
    return onto;
}

Model model_of(const Ground& ground, const Movers& movers, const Eigen::VectorXd& mobility) {
    const Sheet sheet = solve_sheet(ground.face.mesh, ground.skin, ground.weld, movers, ground.scale, {});
    const Eigen::MatrixXd covariance = covariance_of(sheet.energy);
    const Eigen::VectorXd factor = mobility.array() / covariance.diagonal().array().sqrt();
    return {sheet.energy, factor.asDiagonal() * covariance * factor.asDiagonal(), seen_by_all(ground, sheet, movers)};
}

// What a rig misses that has only the columns marked as known.
double missed(const Model& model, const std::vector<bool>& known) {
    Columns p, r;
    for (std::size_t i = 0; i < known.size(); ++i) (known[i] ? p : r).push_back(static_cast<Eigen::Index>(i));
    if (r.empty()) return 0;
    const Eigen::MatrixXd e_rr = model.energy(r, r), e_rp = model.energy(r, p);
    const Eigen::MatrixXd b = -e_rr.ldlt().solve(e_rp);
    const Eigen::MatrixXd s_rp = model.prior(r, p);
    const Eigen::MatrixXd crossed = b * s_rp.transpose();
    const Eigen::MatrixXd off =
        model.prior(r, r) - crossed - crossed.transpose() + b * model.prior(p, p) * b.transpose();
    return std::sqrt(std::max(0.0, (model.onto(r, r).array() * off.array()).sum()));
}

// A site, or a pair of them: indices into the candidates.
using Group = std::vector<std::size_t>;

std::vector<Group> groups_of(const std::vector<Placed>& placed) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const bool is_partner = !groups.empty() && placed[groups.back().front()].site.mirror == placed[i].site.id;
        if (is_partner)
            groups.back().push_back(i);
        else
            groups.push_back({i});
    }
    return groups;
}

bool lacks_chin(const Face& face) {
    constexpr std::array chin{"2.1", "2.10", "2.11", "2.12"};
    return std::none_of(chin.begin(), chin.end(), [&](const char* id) { return find_point(face.points, id); });
}

// The group that lowers the miss most for a point, among those that `allowed` points leave room for.
std::optional<std::size_t> best_group(const Model& model, const std::vector<Group>& groups,
                                      const std::vector<bool>& known, std::size_t first, std::size_t allowed) {
    std::optional<std::size_t> best;
    const double before = missed(model, known);
    double most = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].size() > allowed || known[first + groups[g].front()]) continue;
        std::vector<bool> with = known;
        for (const std::size_t c : groups[g]) with[first + c] = true;
        const double gain = (before - missed(model, with)) / static_cast<double>(groups[g].size());
        if (gain <= most) continue;
        most = gain;
        best = g;
    }
    return best;
}

std::optional<std::size_t> chin_group(const std::vector<Placed>& placed, const std::vector<Group>& groups) {
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& group) { return placed[group.front()].point.id == "2.10"; });
    if (found == groups.end()) return std::nullopt;
    return static_cast<std::size_t>(found - groups.begin());
}

std::vector<Suggestion> choose(const Face& face, const Model& model, const std::vector<Placed>& placed,
                               std::vector<bool> known, std::uint32_t count) {
    const std::size_t first = known.size() - placed.size();
    const std::vector<Group> groups = groups_of(placed);
    const double motion = model.motion();
    std::vector<Suggestion> chosen;
    while (chosen.size() < count) {
        std::optional<std::size_t> next;
        if (chosen.empty() && lacks_chin(face)) next = chin_group(placed, groups);
        if (!next) next = best_group(model, groups, known, first, count - chosen.size());
        if (!next) break;
        const double before = missed(model, known) / motion;
        for (const std::size_t c : groups[*next]) known[first + c] = true;
        const double after = missed(model, known) / motion;
        for (const std::size_t c : groups[*next])
            chosen.push_back({placed[c].point, std::string(placed[c].site.words), before, after});
    }
    return chosen;
}

}  // namespace

std::vector<Suggestion> suggest_points(const Face& face, const SuggestOptions& options) {
    const Ground ground = ground_of(face);
    const std::vector<Site> sites = skin_sites();
    const std::vector<Placed> placed = candidates(ground, sites);

    Movers movers;
    std::vector<double> mobility;
    const auto add = [&](const FeaturePoint& point, double moves) {
        movers.points.push_back(static_cast<std::uint16_t>(movers.points.size()));
        movers.places.push_back(ground.weld.place[point.vertex]);
        mobility.push_back(moves);
    };
    for (const FeaturePoint& point : face.points)
        if (ground.solved[ground.weld.place[point.vertex]]) add(point, mobility_of(point, sites));
    std::vector<bool> known(mobility.size(), true);
    for (const Placed& candidate : placed) add(candidate.point, candidate.site.mobility);
    known.resize(mobility.size(), false);

    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(mobility.data(), std::ssize(mobility));
    return choose(face, model_of(ground, movers, q), placed, std::move(known), options.count);
}

}  // namespace mien
