// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/fap_columns.hpp"

namespace mien {

/// One interval of one parameter's displacement.
struct Interval {
    std::size_t column = 0;  ///< of `FapColumns`
    double low = 0, high = 0;
    bool operator==(const Interval&) const = default;
};

/// A linear model of the motion: intervals, their course over the frames, and the sums that least squares needs.
struct Model {
    std::vector<Interval> intervals;
    Eigen::MatrixXd course;  ///< frames x intervals, each with mean square 1
    Eigen::VectorXd sizes;   ///< one per interval: FAP units that a course of 1 is
    Eigen::MatrixXd gram;    ///< course^T course / frames
    Eigen::MatrixXd right;   ///< intervals x 3 places: course^T displacements / frames
};

/// Chooses how each parameter is bent and sums up the motion of the vertices over the frames. `motion`: filled with
/// the mean square displacement per place and axis.
Model fit_model(const MeshSequence& sequence, const FapColumns& columns, std::span<const std::uint32_t> vertices,
                Eigen::VectorXd& motion);

/// What the shares are drawn to, and how strongly.
struct Expectation {
    Eigen::MatrixXd fields;     ///< intervals x 3 places: displacement at a course of 1
    Eigen::MatrixXd distances;  ///< intervals x places: from the parameter's point, in eye distances
    Eigen::VectorXd least;      ///< per interval: shares that never move a vertex this far are dropped; mesh's unit
};

/// The share of each interval in the motion of each place: intervals x 3 places, displacement at a course of 1. An
/// interval either moves a place or is 0 there.
Eigen::MatrixXd shares(const Model& model, const Expectation& expectation);

/// What shares leave of the mean square displacement of each place.
Eigen::VectorXd left_by(const Model& model, const Eigen::MatrixXd& shares, const Eigen::VectorXd& motion);

/// What the best linear mix of all intervals leaves of the mean square displacement, per place and axis.
Eigen::VectorXd beyond_of(const Model& model, const Eigen::VectorXd& motion);

}  // namespace mien
