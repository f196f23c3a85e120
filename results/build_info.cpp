#include "results/build_info.h"

#include <hdf5.h>
#include <mpi.h>
#include <openssl/crypto.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/mesh/remesh.h"

// MORULA_VERSION, MORULA_GIT_HASH and MORULA_BUILD_TYPE are given to this file alone, so that a new commit compiles one file.

namespace morula::scenarios {
namespace {

std::string dotted(unsigned a, unsigned b, unsigned c) { return std::to_string(a) + '.' + std::to_string(b) + '.' + std::to_string(c); }

}  // namespace

BuildInfo build_info() {
  BuildInfo info;
  info.version = MORULA_VERSION;
  info.git_hash = MORULA_GIT_HASH;
#if defined(__clang__)
  info.compiler = "clang " __clang_version__;
#else
  info.compiler = "g++ " __VERSION__;
#endif
  info.build_type = MORULA_BUILD_TYPE;
  info.licence = has_remesher() ? "GPL-3.0-or-later as a whole (source: BSD-3-Clause; linked with CGAL's mesh processing)"
                                : "BSD-3-Clause (built without code under the GPL: cells from files cannot be remeshed)";
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  info.libraries.emplace_back("hdf5", dotted(major, minor, release));
  char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(mpi, &length);
  const std::string text(mpi, static_cast<std::size_t>(length));
  info.libraries.emplace_back("mpi", text.substr(0, text.find_first_of(",\n")));
  info.libraries.emplace_back("openssl", OpenSSL_version(OPENSSL_VERSION_STRING));
  info.libraries.emplace_back("nlohmann_json",
                              dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH));
  return info;
}

}  // namespace morula::scenarios
