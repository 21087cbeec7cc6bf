// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/prior.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace mien {
namespace {

constexpr std::size_t shapes = 6, points = 4;

// A prior of random numbers whose stiffness has a condition as that of real ones, about 10.
Prior random_prior(unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    Prior prior;
    prior.shapes.resize(shapes);
    for (std::size_t i = 0; i < shapes * points; ++i)
        prior.response.push_back({number(engine), number(engine), number(engine)});
    Eigen::MatrixXd A(shapes, shapes);
    for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = number(engine);
    const Eigen::MatrixXd H = A * A.transpose() + Eigen::MatrixXd::Identity(shapes, shapes);
    prior.stiffness.assign(H.data(), H.data() + H.size());
    return prior;
}

std::vector<Vec3f> random_motion(unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> number(-1, 1);
    std::vector<Vec3f> motion;
    for (std::size_t i = 0; i < points; ++i) motion.push_back({number(engine), number(engine), number(engine)});
    return motion;
}

Eigen::VectorXd solved(const Prior& prior, const std::vector<Vec3f>& motion) {
    std::vector<float> weights(prior.shapes.size());
    shape_weights(prior, motion, weights);
    return Eigen::Map<Eigen::VectorXf>(weights.data(), static_cast<Eigen::Index>(weights.size())).cast<double>();
}

Eigen::MatrixXd stiffness_of(const Prior& prior) {
    return Eigen::Map<const Eigen::MatrixXd>(prior.stiffness.data(), shapes, shapes);
}

Prior linear(Prior prior) {
    prior.stiffness.clear();
    return prior;
}

// By trying every set of entries that are not zero: of those that leave no entry negative, the least cost.
Eigen::VectorXd by_enumeration(const Eigen::MatrixXd& H, const Eigen::VectorXd& y) {
    Eigen::VectorXd best = Eigen::VectorXd::Zero(y.size());
    double least = 0;
    for (unsigned set = 1; set < 1U << shapes; ++set) {
        std::vector<Eigen::Index> open;
        for (Eigen::Index i = 0; i < y.size(); ++i)
            if ((set >> i & 1U) != 0) open.push_back(i);
        const Eigen::VectorXd part = Eigen::MatrixXd(H(open, open)).ldlt().solve(Eigen::VectorXd(y(open)));
        Eigen::VectorXd c = Eigen::VectorXd::Zero(y.size());
        c(open) = part;
        const double cost = c.dot(H * c) / 2 - y.dot(c);
        if ((part.array() < 0).any() || cost >= least) continue;
        least = cost;
        best = c;
    }
    return best;
}

TEST(Prior, NoMotionShowsNoShape) {
    EXPECT_EQ(solved(random_prior(1), std::vector<Vec3f>(points)), Eigen::VectorXd::Zero(shapes));
}

TEST(Prior, WithoutStiffnessTheWeightsAreLinearInTheMotion) {
    const Prior prior = linear(random_prior(1));
    const std::vector<Vec3f> a = random_motion(1), b = random_motion(2);
    std::vector<Vec3f> sum;
    for (std::size_t i = 0; i < points; ++i) sum.push_back(a[i] - 2.0F * b[i]);
    EXPECT_LT((solved(prior, sum) - (solved(prior, a) - 2 * solved(prior, b))).norm(), 1e-5);
    EXPECT_LT(solved(prior, a).minCoeff(), 0);
}

TEST(Prior, WithStiffnessTheWeightsAreTheBestOfThoseThatOnlyAdd) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const Prior prior = random_prior(seed);
        const std::vector<Vec3f> motion = random_motion(seed + 100);
        const Eigen::VectorXd y = stiffness_of(prior) * solved(linear(prior), motion);
        const Eigen::VectorXd expected = by_enumeration(stiffness_of(prior), y), found = solved(prior, motion);
        EXPECT_GE(found.minCoeff(), 0) << seed;
        EXPECT_LT((found - expected).norm(), 2e-3 * (1 + expected.norm())) << seed;
    }
}

TEST(Prior, WhereNothingWouldBeTakenAwayBothSolvesAgree) {
    Prior prior = random_prior(3);
    for (Vec3& r : prior.response) r = {std::abs(r.x), std::abs(r.y), std::abs(r.z)};
    const std::vector<Vec3f> motion(points, Vec3f{0.3F, 0.1F, 0.2F});
    EXPECT_LT((solved(prior, motion) - solved(linear(prior), motion)).norm(), 1e-6);
}

TEST(Prior, TwiceTheMotionShowsTwiceTheShapes) {
    const Prior prior = random_prior(4);
    std::vector<Vec3f> motion = random_motion(4);
    const Eigen::VectorXd once = solved(prior, motion);
    for (Vec3f& d : motion) d = 2.0F * d;
    EXPECT_LT((solved(prior, motion) - 2 * once).norm(), 1e-5);
}

// A motion runs straight through places where shapes come in and go out.
TEST(Prior, HalfTheStepInMotionIsHalfTheStepInWeights) {
    const Prior prior = random_prior(5);
    const std::vector<Vec3f> from = random_motion(6), to = random_motion(7);
    const auto largest_step = [&](int rows) {
        double largest = 0;
        Eigen::VectorXd before = solved(prior, from);
        for (int r = 1; r <= rows; ++r) {
            std::vector<Vec3f> motion;
            for (std::size_t i = 0; i < points; ++i)
                motion.push_back(from[i] + static_cast<float>(r) / static_cast<float>(rows) * (to[i] - from[i]));
            const Eigen::VectorXd now = solved(prior, motion);
            largest = std::max(largest, (now - before).norm());
            before = now;
        }
        return largest;
    };
    EXPECT_NEAR(largest_step(64) / largest_step(128), 2, 0.05);
    EXPECT_NEAR(largest_step(128) / largest_step(256), 2, 0.05);
}

}  // namespace
}  // namespace mien
