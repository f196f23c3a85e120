#include "fields/interval_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

TEST(IntervalOfAField, FollowsItsChange) {
  EXPECT_DOUBLE_EQ(next_interval(10.0, 9e-4, 1e-3), 10.0);
  EXPECT_DOUBLE_EQ(next_interval(10.0, 3.6e-3, 1e-3), 2.5) << "four times the change that is allowed";
  EXPECT_DOUBLE_EQ(next_interval(10.0, 6e-4, 1e-3), 15.0);
  EXPECT_DOUBLE_EQ(next_interval(10.0, 0.0, 1e-3), 20.0) << "not above twice the last";
  EXPECT_DOUBLE_EQ(next_interval(200.0, 1e-6, 1e-3), 300.0);
  EXPECT_DOUBLE_EQ(next_interval(200.0, 0.0, 0.0), 0.0) << "a tolerance of 0 is one integration a step";
}

TEST(IntervalOfAField, EndsWithItsTimeOrWhereACellHasGoneATenthOfAVoxel) {
  FieldSpec spec;
  spec.voxel = 10.0;
  Space space;
  space.box = {{0, 0, 0}, {80, 80, 40}};
  Field field = field_of(spec, space);
  field.time = 100.0;
  field.interval = 30.0;
  EXPECT_FALSE(is_due(field, 129.0));
  EXPECT_TRUE(is_due(field, 130.0));
  field.way = 0.99;
  EXPECT_FALSE(is_due(field, 129.0));
  field.way = 1.01;
  EXPECT_TRUE(is_due(field, 101.0));
}

TEST(IntervalOfAField, IsToldByTheSolverAsThePartOfTheLargestConcentration) {
  // Everything decays: c = c0 e^(−kt) everywhere, so that the change is 1 − e^(−kt) of what was there.
  FieldSpec spec;
  spec.voxel = 10.0;
  spec.initial = 0.2;
  spec.relative_tolerance = 1e-8;
  spec.reactions = {decay_of(1e-3)};
  Space space;
  space.box = {{0, 0, 0}, {40, 40, 40}};
  Field field = field_of(spec, space);
  EXPECT_NEAR(advance(field, spec, space, 100.0).change, 1.0 - std::exp(-0.1), 1e-6);
}

}  // namespace
}  // namespace morula::fields::test
