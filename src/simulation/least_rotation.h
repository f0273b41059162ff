#pragma once
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace svnet {

/// The rotation by the smallest angle that turns the direction of `from` into that of `to`: the bits of Eigen's
/// Quaternion::FromTwoVectors, without its singular value decomposition, which takes ten seconds to compile. Of that,
/// only the first step matters here, a QR decomposition: its last column is the axis of half a turn.
template <class Scalar>
Eigen::Quaternion<Scalar> least_rotation(const Eigen::Matrix<Scalar, 3, 1>& from,
                                         const Eigen::Matrix<Scalar, 3, 1>& to) {
  const Eigen::Matrix<Scalar, 3, 1> a = from.normalized(), b = to.normalized();
  const Scalar cosine = b.dot(a);
  Eigen::Quaternion<Scalar> rotation;
  if (cosine < Scalar(-1) + Eigen::NumTraits<Scalar>::dummy_precision()) {
    Eigen::Matrix<Scalar, 3, 2> both;
    both << a, b;
    both /= both.cwiseAbs().maxCoeff();
    const Eigen::Matrix<Scalar, 3, 3> q = Eigen::ColPivHouseholderQR<Eigen::Matrix<Scalar, 3, 2>>(both).householderQ();
    const Scalar w_squared = (1 + std::max(cosine, Scalar(-1))) / 2;
    rotation.w() = std::sqrt(w_squared);
    rotation.vec() = q.col(2) * std::sqrt(1 - w_squared);
    return rotation;
  }
  const Scalar s = std::sqrt((1 + cosine) * 2);
  rotation.w() = s / 2;
  rotation.vec() = a.cross(b) * (1 / s);
  return rotation;
}

}  // namespace svnet
