#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// The rotation between two directions. It has the bits of Eigen's Quaternion::FromTwoVectors, which takes ten seconds
// to compile in each file that calls it: for opposite directions it instantiates a singular value decomposition.
namespace svnet::simulation {

/// A unit vector that is perpendicular to the nearly opposite unit vectors a and b: the last column of Q in the QR
/// decomposition of (a, b) by Householder reflections, with the longer column first.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> half_turn_axis(Eigen::Matrix<Scalar, 3, 1> a, Eigen::Matrix<Scalar, 3, 1> b) {
  const Scalar largest = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  a /= largest;
  b /= largest;
  if (b.norm() > a.norm()) std::swap(a, b);
  constexpr Scalar kTiny = std::numeric_limits<Scalar>::min();
  // The reflection I - tau v vᵀ with v = (1, u, w) turns a to the first axis.
  Scalar u = 0, w = 0, tau = 0;
  if (const Scalar rest = a.y() * a.y() + a.z() * a.z(); rest > kTiny) {
    const Scalar length = std::sqrt(a.x() * a.x() + rest), beta = a.x() >= 0 ? -length : length;
    u = a.y() / (a.x() - beta);
    w = a.z() / (a.x() - beta);
    tau = (beta - a.x()) / beta;
    const Scalar along = (u * b.y() + w * b.z()) + b.x();
    b.y() -= tau * u * along;
    b.z() -= tau * w * along;
  }
  // The second one, with v = (0, 1, second), turns what is left of b to the second axis.
  Scalar second = 0, second_tau = 0;
  if (const Scalar rest = b.z() * b.z(); rest > kTiny) {
    const Scalar length = std::sqrt(b.y() * b.y() + rest), beta = b.y() >= 0 ? -length : length;
    second = b.z() / (b.y() - beta);
    second_tau = (beta - b.y()) / beta;
  }
  // Both applied to the third axis.
  const Scalar y = 0 - second_tau * second, z = 1 - second_tau * second * second;
  const Scalar along = u * y + w * z;
  return {0 - tau * along, y - tau * u * along, z - tau * w * along};
}

/// The rotation by the smallest angle that turns the direction of `from` into that of `to`.
template <class Scalar>
Eigen::Quaternion<Scalar> least_rotation(const Eigen::Matrix<Scalar, 3, 1>& from,
                                         const Eigen::Matrix<Scalar, 3, 1>& to) {
  const Eigen::Matrix<Scalar, 3, 1> a = from.normalized(), b = to.normalized();
  const Scalar cosine = b.dot(a);
  Eigen::Quaternion<Scalar> rotation;
  if (cosine < Scalar(-1) + Eigen::NumTraits<Scalar>::dummy_precision()) {
    const Scalar w_squared = (1 + std::max(cosine, Scalar(-1))) / 2;
    rotation.w() = std::sqrt(w_squared);
    rotation.vec() = half_turn_axis<Scalar>(a, b) * std::sqrt(1 - w_squared);
    return rotation;
  }
  const Scalar s = std::sqrt((1 + cosine) * 2);
  rotation.w() = s / 2;
  rotation.vec() = a.cross(b) * (1 / s);
  return rotation;
}

}  // namespace svnet::simulation
