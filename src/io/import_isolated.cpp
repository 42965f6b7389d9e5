// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Importing a mesh in a child process, so that a crash of the importer stays there.
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>

#include "fcl_prob/mesh_io.h"
#include "io/import_isolated.h"
#include "io/write_file.h"

namespace fcl_prob {
namespace {

using Clock = std::chrono::steady_clock;

enum class Outcome : std::uint64_t { mesh, file_error, invalid_geometry, invalid_request, other };

/// What the child sends first; then `first` vertices, `second` triangles and `third` characters of
/// notes, or `first` characters.
struct Message {
  Outcome outcome;
  std::uint64_t first;
  std::uint64_t second;
  std::uint64_t third;
  double coordinate_error;
};

/// Three doubles and three indices, without the classes' own layout.
using RawVertex = std::array<double, 3>;
using RawTriangle = std::array<std::uint64_t, 3>;

// The child.

void limit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

// Sanitizers reserve terabytes of address space.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kShadowMemory = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kShadowMemory = true;
#else
constexpr bool kShadowMemory = false;
#endif
#else
constexpr bool kShadowMemory = false;
#endif

void confine(const ImportLimits& limits) {
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1);
  if (!kShadowMemory) limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);
  // What the importer prints is not for our user.
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    ::dup2(nowhere, standard);
  }
}

void sendMesh(int descriptor, const TriangleMesh& mesh) {
  std::string notes;  // each ends in a 0
  for (const std::string& note : mesh.notes) notes.append(note).push_back('\0');
  const Message message{Outcome::mesh, mesh.vertices.size(), mesh.triangles.size(), notes.size(),
                        mesh.coordinate_error};
  std::vector<RawVertex> vertices;
  for (const fcl::Vector3d& v : mesh.vertices) vertices.push_back({v.x(), v.y(), v.z()});
  std::vector<RawTriangle> triangles;
  for (const fcl::Triangle& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});
  detail::writeAll(descriptor, &message, sizeof message) &&
      detail::writeAll(descriptor, vertices.data(), vertices.size() * sizeof(RawVertex)) &&
      detail::writeAll(descriptor, triangles.data(), triangles.size() * sizeof(RawTriangle)) &&
      detail::writeAll(descriptor, notes.data(), notes.size());
}

void sendError(int descriptor, Outcome outcome, const char* text) {
  const Message message{outcome, std::strlen(text), 0, 0, 0.0};
  detail::writeAll(descriptor, &message, sizeof message) &&
      detail::writeAll(descriptor, text, message.first);
}

/// Never returns to the caller's code: no destructor or exit handler of the parent may run here.
[[noreturn]] void importAndSend(int descriptor, const std::function<TriangleMesh()>& import,
                                const ImportLimits& limits) {
  confine(limits);
  try {
    sendMesh(descriptor, import());
  } catch (const FileError& error) {
    sendError(descriptor, Outcome::file_error, error.what());
  } catch (const InvalidGeometry& error) {
    sendError(descriptor, Outcome::invalid_geometry, error.what());
  } catch (const InvalidRequest& error) {
    sendError(descriptor, Outcome::invalid_request, error.what());
  } catch (const std::exception& error) {
    sendError(descriptor, Outcome::other, error.what());
  }
  ::_exit(0);
}

// The parent.

class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (!waited_) {
      ::kill(id_, SIGKILL);
      wait();
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    waited_ = true;
    return status;
  }

 private:
  pid_t id_;
  bool waited_ = false;
};

class Receiver {
 public:
  Receiver(int descriptor, const std::string& path, const ImportLimits& limits)
      : descriptor_(descriptor),
        path_(path),
        limits_(limits),
        // Processor time is limited in the child; this catches one that sleeps.
        deadline_(Clock::now() + std::chrono::seconds(2 * std::uint64_t{limits.seconds} + 10)) {}

  /// False if the child's end was closed before `size` bytes had come.
  bool read(void* data, std::size_t size) {
    char* position = static_cast<char*>(data);
    while (size > 0) {
      awaitData();
      const ssize_t received = ::read(descriptor_, position, size);
      if (received < 0 && errno == EINTR) continue;
      if (received <= 0) return false;
      position += received;
      size -= static_cast<std::size_t>(received);
    }
    return true;
  }

  template <typename Item>
  bool readItems(std::uint64_t count, std::vector<Item>& items) {
    if (count > limits_.memory_bytes / sizeof(Item)) return false;
    items.resize(count);
    return read(items.data(), count * sizeof(Item));
  }

 private:
  void awaitData() const {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
    pollfd watched{descriptor_, POLLIN, 0};
    const int wait_ms =
        static_cast<int>(std::max<long long>(0, std::min<long long>(left, 1 << 30)));
    if (::poll(&watched, 1, wait_ms) == 0) {
      throw FileError(path_ + ": the mesh importer did not finish in time");
    }
  }

  int descriptor_;
  const std::string& path_;
  ImportLimits limits_;
  Clock::time_point deadline_;
};

[[noreturn]] void throwError(Outcome outcome, const std::string& text, const std::string& path) {
  switch (outcome) {
    case Outcome::invalid_geometry:
      throw InvalidGeometry(text);
    case Outcome::invalid_request:
      throw InvalidRequest(text);
    case Outcome::file_error:
      throw FileError(text);
    default:
      throw FileError(path + ": the mesh importer failed: " + text);
  }
}

[[noreturn]] void throwDeath(int status, const std::string& path) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    throw FileError(path + ": the mesh importer did not finish in time");
  }
  if (WIFSIGNALED(status)) {
    throw FileError(path + ": the mesh importer crashed on this file (" +
                    ::strsignal(WTERMSIG(status)) + ")");
  }
  throw FileError(path + ": the mesh importer crashed on this file (exit code " +
                  std::to_string(WEXITSTATUS(status)) + ")");
}

/// Nothing if the child ended before it had said everything.
bool receive(Receiver& receiver, const std::string& path, TriangleMesh& mesh) {
  Message message{};
  if (!receiver.read(&message, sizeof message)) return false;
  if (message.outcome != Outcome::mesh) {
    std::vector<char> text;
    if (!receiver.readItems(message.first, text)) return false;
    throwError(message.outcome, std::string(text.begin(), text.end()), path);
  }
  std::vector<RawVertex> vertices;
  std::vector<RawTriangle> triangles;
  if (!receiver.readItems(message.first, vertices)) return false;
  if (!receiver.readItems(message.second, triangles)) return false;
  std::vector<char> notes;
  if (!receiver.readItems(message.third, notes)) return false;
  for (auto begin = notes.begin(); begin != notes.end();) {
    const auto end = std::find(begin, notes.end(), '\0');
    mesh.notes.emplace_back(begin, end);
    begin = end == notes.end() ? end : end + 1;
  }
  mesh.coordinate_error = message.coordinate_error;
  for (const RawVertex& v : vertices) mesh.vertices.emplace_back(v[0], v[1], v[2]);
  for (const RawTriangle& t : triangles) mesh.triangles.emplace_back(t[0], t[1], t[2]);
  return true;
}

}  // namespace

bool detail::importMemoryIsLimited() { return !kShadowMemory; }

TriangleMesh detail::importIsolated(const std::string& path,
                                    const std::function<TriangleMesh()>& import,
                                    const ImportLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw FileError(path + ": no pipe to the importer: " + std::strerror(errno));
  }
  detail::FileDescriptor read_end(ends[0]);
  detail::FileDescriptor write_end(ends[1]);
  std::unique_lock<std::mutex> no_import(detail::importMutex());
  const pid_t id = ::fork();
  no_import.unlock();  // in both processes
  if (id < 0) throw FileError(path + ": no process for the importer: " + std::strerror(errno));
  if (id == 0) importAndSend(write_end.number(), import, limits);

  Child child(id);
  write_end.close();
  TriangleMesh mesh;
  Receiver receiver(read_end.number(), path, limits);
  if (!receive(receiver, path, mesh)) throwDeath(child.wait(), path);
  validateMesh(mesh, path);  // a child that has overwritten its memory may say anything
  return mesh;
}

TriangleMesh loadMeshIsolated(const std::string& path, const MeshOptions& options,
                              const ImportLimits& limits) {
  return detail::importIsolated(
      path, [&] { return loadMesh(path, options, limits); }, limits);
}

}  // namespace fcl_prob
