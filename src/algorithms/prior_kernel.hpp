// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "algorithms/movers.hpp"
#include "algorithms/sheet.hpp"

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// How far a shape moves every place, one row per place, in eye distances. Zero where no rigger solves.
using Field = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// What the prior believes. The names are those of the formulas in rig_prior.cpp; lengths are in eye distances.
struct PriorSetting {
    double a;     ///< tension of the smooth part
    double g;     ///< its share
    double v;     ///< noise: how far example shapes are trusted
    double s;     ///< share of the copy of the shapes
    double sw;    ///< how far that copy reaches
    double beta;  ///< how far large and small shapes are evened out
    double gs;    ///< how much more the smooth part moves where the shapes do
    double mf;    ///< mobility of what no shape moves
    double ms;    ///< how far mobility is smoothed
    double eps;   ///< noise of the points
    double r;     ///< pull of the coefficients to zero
    double x;     ///< size of the helpers beside the own shapes
};

/// Shapes as the prior takes them in.
struct Learnt {
    std::vector<Field> all;    ///< A: own shapes and helpers, evened out, with the points' mean square motion at 1
    Eigen::VectorXd mobility;  ///< q of every place
};

/// A head with what a rigger asks of it.
struct Ground {
    const Face& face;
    Weld joined;
    std::vector<bool> solved;           ///< per place
    std::vector<std::uint32_t> points;  ///< places of the feature points on the skin
    double scale = 1;                   ///< eye distance
    SheetSkin skin;
};

/// Throws Error unless the face has what every rigger asks for.
Ground ground_of(const Face& face);

/// Squared size of a field, each place counting once.
double squared_size(const Field& field);

/// The factors (size / mean size)^-beta that even shapes out, times one number so that the sum over shapes and `places`
/// of the squared motion is the number of places. No shape may be of size zero.
std::vector<double> evening_factors(std::span<const Field> shapes, std::span<const std::uint32_t> places, double beta);

/// Steps 1 to 3: `own` and `helpers` evened out and put together, and how mobile each place is.
Learnt learn(const Ground& ground, std::span<const Field> own, std::span<const Field> helpers,
             const PriorSetting& setting);

/// Steps 4 to 6: S = (G + B) / 3, places x movers: how every place moves with every point, when points are all that is
/// known.
Eigen::MatrixXd kernel(const Ground& ground, const Movers& movers, const Learnt& learnt, const PriorSetting& setting);

}  // namespace mien
