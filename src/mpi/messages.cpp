// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mpi/messages.h"

#include <chrono>
#include <climits>
#include <nlohmann/json.hpp>
#include <thread>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::mpi {
namespace {

using Json = nlohmann::json;

/// Texts are not checked: lines of the file need not be UTF-8.
std::string cborOf(const Json& message) {
  std::string cbor;
  Json::to_cbor(message, cbor);
  return cbor;
}

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
  Json message = Json::array();
  for (const sweep::NumberedLine& line : lines) {
    message.push_back(Json::array({line.number, line.text, line.too_long}));
  }
  return cborOf(message);
}

Lines linesFrom(const std::string& message) {
  Lines lines;
  for (const Json& line : Json::from_cbor(message)) lines.push_back({line[0], line[1], line[2]});
  return lines;
}

std::string packed(const Answered& answered) {
  return cborOf(Json::array({answered.records, answered.errors}));
}

Answered answeredFrom(const std::string& message) {
  const Json answered = Json::from_cbor(message);
  return {answered[0], answered[1]};
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
