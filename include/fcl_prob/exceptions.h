// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the library throws. Every message names the offending value; nothing is silently repaired.
#pragma once

#include <stdexcept>

namespace fcl_prob {

/// Base of all exceptions of this library.
class Exception : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A mean or covariance that is not finite, not symmetric or not positive semidefinite; a mixture
/// whose weights are not a distribution.
class InvalidDistribution : public Exception {
  using Exception::Exception;
};

/// A pose that is not finite or not rigid.
class InvalidPose : public Exception {
  using Exception::Exception;
};

/// A geometry that is empty, unfinished, or has non-finite vertices or indices out of range.
class InvalidGeometry : public Exception {
  using Exception::Exception;
};

/// A geometry, or a pair of geometries, that the chosen method cannot handle.
class UnsupportedGeometry : public Exception {
  using Exception::Exception;
};

/// `contact = solid` was asked of a mesh that is not closed.
class OpenMesh : public Exception {
  using Exception::Exception;
};

/// A field of a request that is out of its range, or fields that contradict each other.
class InvalidRequest : public Exception {
  using Exception::Exception;
};

/// A file that cannot be read, or is not what it says it is.
class FileError : public Exception {
  using Exception::Exception;
};

}  // namespace fcl_prob
