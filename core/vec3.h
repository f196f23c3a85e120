#pragma once
#include <cstddef>

#include "core/simd/lane.h"

namespace morula {

/// A vector of three components; Real is double, float or a Lane of either.
template <class Real>
struct Vec3 {
  Real x{}, y{}, z{};

  Real& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  const Real& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const Vec3& a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(Real s, const Vec3& a) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator/(const Vec3& a, Real s) { return {a.x / s, a.y / s, a.z / s}; }
  Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  Vec3& operator*=(Real s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

template <class Real>
Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
Real norm2(const Vec3<Real>& a) {
  return dot(a, a);
}
template <class Real>
Real norm(const Vec3<Real>& a) {
  return sqrt(dot(a, a));
}
/// a/|a|. Precondition: a is not zero.
template <class Real>
Vec3<Real> normalized(const Vec3<Real>& a) {
  return a * (Real(1.0) / norm(a));
}

/// A symmetric 3×3 matrix.
template <class Real>
struct SymMat3 {
  Real xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  friend SymMat3 operator+(const SymMat3& a, const SymMat3& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
  }
  SymMat3& operator+=(const SymMat3& b) { return *this = *this + b; }
  friend SymMat3 operator*(Real s, const SymMat3& a) { return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz}; }
  friend Vec3<Real> operator*(const SymMat3& a, const Vec3<Real>& v) {
    return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z, a.xz * v.x + a.yz * v.y + a.zz * v.z};
  }
};

/// s v vᵀ
template <class Real>
SymMat3<Real> outer(Real s, const Vec3<Real>& v) {
  return {s * v.x * v.x, s * v.x * v.y, s * v.x * v.z, s * v.y * v.y, s * v.y * v.z, s * v.z * v.z};
}
/// s I
template <class Real>
SymMat3<Real> isotropic(Real s) {
  return {s, Real(0.0), Real(0.0), s, Real(0.0), s};
}

inline double determinant(const SymMat3<double>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) + a.xy * (a.xz * a.yz - a.xy * a.zz) + a.xz * (a.xy * a.yz - a.xz * a.yy);
}

/// Inverse of a matrix that has one.
inline SymMat3<double> inverse(const SymMat3<double>& a) {
  const double c00 = a.yy * a.zz - a.yz * a.yz, c01 = a.xz * a.yz - a.xy * a.zz, c02 = a.xy * a.yz - a.xz * a.yy;
  const double s = 1.0 / determinant(a);
  return {c00 * s, c01 * s, c02 * s, (a.xx * a.zz - a.xz * a.xz) * s, (a.xy * a.xz - a.xx * a.yz) * s, (a.xx * a.yy - a.xy * a.xy) * s};
}

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

inline Vec3f to_float(const Vec3d& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
inline SymMat3<float> to_float(const SymMat3<double>& a) {
  return {static_cast<float>(a.xx), static_cast<float>(a.xy), static_cast<float>(a.xz),
          static_cast<float>(a.yy), static_cast<float>(a.yz), static_cast<float>(a.zz)};
}

}  // namespace morula
