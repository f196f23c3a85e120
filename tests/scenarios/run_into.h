#pragma once
#include <gtest/gtest.h>

#include <filesystem>

#include "scenarios/run/driver.h"

namespace morula::scenarios::test {

/// Runs a study into a folder that does not exist yet, as a user would on one rank; expects that it ends well.
inline bool run_into(const std::filesystem::path& out, const Study& study) {
  RunRequest request;
  request.out = out;
  request.command = "a test";
  const auto done = run(study, request, Comm());
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().message);
  return done.ok();
}

}  // namespace morula::scenarios::test
