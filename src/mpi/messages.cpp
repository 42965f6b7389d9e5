// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mpi/messages.h"

#include <chrono>
#include <climits>
#include <cstring>
#include <thread>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::mpi {
namespace {

void put(std::string& message, std::uint64_t number) {
  message.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string& message, const std::string& text) {
  put(message, std::uint64_t{text.size()});
  message += text;
}

/// Takes apart what put() has put together.
class Reader {
 public:
  explicit Reader(const std::string& message) : message_(message) {}
  bool atEnd() const { return position_ == message_.size(); }

  std::uint64_t number() {
    std::uint64_t number = 0;
    std::memcpy(&number, take(sizeof number), sizeof number);
    return number;
  }

  std::string text() {
    const auto size = static_cast<std::size_t>(number());
    return {take(size), size};
  }

 private:
  const char* take(std::size_t size) {
    if (size > message_.size() - position_) throw Exception("a message of MPI is cut off");
    const char* data = message_.data() + position_;
    position_ += size;
    return data;
  }

  const std::string& message_;
  std::size_t position_ = 0;
};

std::string received(MPI_Message message, const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Mrecv(text.data(), size, MPI_CHAR, &message, MPI_STATUS_IGNORE);
  return text;
}

void waitFor(MPI_Request& request) {
  for (int is_done = 0;;) {
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done != 0) return;
    sleepAWhile();
  }
}

}  // namespace

std::string packed(const Lines& lines) {
  std::string message;
  for (const sweep::NumberedLine& line : lines) {
    put(message, std::uint64_t{line.number});
    put(message, std::uint64_t{line.too_long});
    put(message, line.text);
  }
  return message;
}

Lines linesFrom(const std::string& message) {
  Lines lines;
  for (Reader reader(message); !reader.atEnd();) {
    sweep::NumberedLine line;
    line.number = static_cast<std::size_t>(reader.number());
    line.too_long = reader.number() != 0;
    line.text = reader.text();
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string packed(const Answered& answered) {
  std::string message;
  put(message, std::uint64_t{answered.errors});
  for (const std::string& record : answered.records) put(message, record);
  return message;
}

Answered answeredFrom(const std::string& message) {
  Answered answered;
  Reader reader(message);
  answered.errors = static_cast<std::size_t>(reader.number());
  while (!reader.atEnd()) answered.records.push_back(reader.text());
  return answered;
}

void send(const std::string& message, int rank, Tag tag) {
  if (message.size() > INT_MAX) throw Exception("a message of MPI is too long");
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD,
            &request);
  waitFor(request);
}

std::string receive(int rank, Tag tag) {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  for (int is_there = 0;;) {
    MPI_Improbe(rank, tag, MPI_COMM_WORLD, &is_there, &message, &status);
    if (is_there != 0) return received(message, status);
    sleepAWhile();
  }
}

Mail mailFromAnyone(Tag tag) {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  int is_there = 0;
  MPI_Improbe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &is_there, &message, &status);
  if (is_there == 0) return {};
  return {status.MPI_SOURCE, received(message, status)};
}

void waitForAll() {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  waitFor(request);
}

void sleepAWhile() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

}  // namespace fcl_prob::mpi
