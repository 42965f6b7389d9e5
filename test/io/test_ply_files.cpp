// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// PLY: one brick as text and in both byte orders, with what programs put beside it; triangle
// strips; counts that are wrong.
#include <algorithm>
#include <cstring>

#include "brick.h"
#include "io/mesh_formats.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

enum class Encoding { text, little_endian, big_endian };
constexpr std::array<Encoding, 3> kEncodings{Encoding::text, Encoding::little_endian,
                                             Encoding::big_endian};

/// Writes numbers of a file's types, one element a line.
class PlyWriter {
 public:
  explicit PlyWriter(Encoding encoding) : encoding_(encoding) {
    constexpr std::array<const char*, 3> kNames{"ascii", "binary_little_endian",
                                                "binary_big_endian"};
    text_ = std::string("ply\nformat ") + kNames[static_cast<std::size_t>(encoding)] + " 1.0\n";
  }

  PlyWriter& header(const std::string& lines) {
    text_ += lines;
    return *this;
  }
  PlyWriter& body() { return header("end_header\n"); }

  PlyWriter& number(const std::string& type, const std::string& decimal) {
    if (encoding_ == Encoding::text) {
      text_ += decimal + " ";
      return *this;
    }
    const double value = std::strtod(decimal.c_str(), nullptr);
    if (type == "float") return bytesOf(static_cast<float>(value));
    if (type == "double") return bytesOf(value);
    if (type == "uchar") return bytesOf(static_cast<std::uint8_t>(value));
    if (type == "ushort") return bytesOf(static_cast<std::uint16_t>(value));
    if (type == "uint")
      return bytesOf(static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
    REQUIRE(type == "int");
    return bytesOf(static_cast<std::int32_t>(value));
  }

  PlyWriter& list(const std::string& length_type, const std::string& type,
                  const std::vector<int>& values) {
    number(length_type, std::to_string(values.size()));
    for (const int value : values) number(type, std::to_string(value));
    return *this;
  }

  PlyWriter& end() {
    if (encoding_ == Encoding::text) text_ += "\n";
    return *this;
  }

  const std::string& text() const { return text_; }

 private:
  template <typename Number>
  PlyWriter& bytesOf(Number value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (encoding_ == Encoding::big_endian) std::reverse(bytes.begin(), bytes.end());
    text_ += bytes;
    return *this;
  }

  Encoding encoding_;
  std::string text_;
};

struct Dialect {
  std::string coordinate = "double";
  std::string length = "uchar";
  std::string index = "int";
  std::string list_name = "vertex_indices";
  bool has_extras = false;
  bool faces_first = false;
  int vertices_told = 8;
  int faces_told = 6;
};

void writeVertices(const Brick& brick, const Dialect& dialect, PlyWriter& writer) {
  for (int i = 0; i < 8; ++i) {
    if (dialect.has_extras) writer.number("uchar", "200").list("uchar", "float", {1, 2, 3});
    // y before x: properties come in any order.
    writer.number(dialect.coordinate, brick.sides[1][(i >> 1) & 1]);
    writer.number(dialect.coordinate, brick.sides[0][i & 1]);
    writer.number(dialect.coordinate, brick.sides[2][(i >> 2) & 1]);
    if (dialect.has_extras) writer.number("float", "nan");
    writer.end();
  }
}

void writeFaces(const Dialect& dialect, PlyWriter& writer) {
  for (const Corners& q : kQuads) {
    if (dialect.has_extras) writer.number("int", "-7");
    writer.list(dialect.length, dialect.index, q);
    if (dialect.has_extras) writer.list("uchar", "float", {0, 1}).number("uchar", "255");
    writer.end();
  }
}

std::string plyFile(Encoding encoding, const Brick& brick, const Dialect& dialect = {}) {
  const std::string xyz = "property " + dialect.coordinate + " ";
  std::string vertices = "element vertex " + std::to_string(dialect.vertices_told) + "\n";
  if (dialect.has_extras) vertices += "property uchar red\nproperty list uchar float weights\n";
  vertices += xyz + "y\n" + xyz + "x\n" + xyz + "z\n";
  if (dialect.has_extras) vertices += "property float quality\n";
  std::string faces = "element face " + std::to_string(dialect.faces_told) + "\n";
  if (dialect.has_extras) faces += "property int flags\n";
  faces += "property list " + dialect.length + " " + dialect.index + " " + dialect.list_name + "\n";
  if (dialect.has_extras) faces += "property list uchar float texcoord\nproperty uchar alpha\n";
  PlyWriter writer(encoding);
  writer.header("comment of no importance\nobj_info neither\n");
  writer.header(dialect.faces_first ? faces + vertices : vertices + faces);
  if (dialect.has_extras)
    writer.header("element edge 2\nproperty int vertex1\nproperty int vertex2\n");
  writer.body();
  if (dialect.faces_first) writeFaces(dialect, writer);
  writeVertices(brick, dialect, writer);
  if (!dialect.faces_first) writeFaces(dialect, writer);
  for (int i = 0; dialect.has_extras && i < 2; ++i) {
    writer.number("int", "0").number("int", "1").end();
  }
  return writer.text();
}

/// Every quadrilateral is a strip; they are joined by -1, or by corners that are there twice.
std::vector<int> stripOf(const std::vector<Corners>& quads, bool is_stitched) {
  std::vector<int> strip;
  for (const Corners& q : quads) {
    if (!strip.empty() && is_stitched) strip.insert(strip.end(), {strip.back(), q[0]});
    if (!strip.empty() && !is_stitched) strip.push_back(-1);
    strip.insert(strip.end(), {q[0], q[1], q[3], q[2]});
  }
  return strip;
}

std::string stripFile(Encoding encoding, const Brick& brick, const std::string& index_type,
                      const std::vector<std::vector<int>>& strips) {
  PlyWriter writer(encoding);
  writer.header("element vertex 8\nproperty double y\nproperty double x\nproperty double z\n");
  writer.header("element tristrips " + std::to_string(strips.size()) + "\nproperty list int " +
                index_type + " vertex_indices\n");
  writer.body();
  writeVertices(brick, {}, writer);
  for (const std::vector<int>& strip : strips) writer.list("int", index_type, strip).end();
  return writer.text();
}

}  // namespace

TEST_CASE("a PLY file in its dialects", "[io]") {
  std::mt19937 generator(47);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const Brick brick = randomBrick(generator);
    for (const char* length : {"uchar", "ushort", "uint", "int"}) {
      for (const char* index : {"uchar", "ushort", "uint", "int"}) {
        for (const bool has_extras : {false, true}) {
          for (const bool faces_first : {false, true}) {
            Dialect dialect;
            dialect.length = length;
            dialect.index = index;
            dialect.list_name = has_extras ? "vertex_index" : "vertex_indices";
            dialect.has_extras = has_extras;
            dialect.faces_first = faces_first;
            for (const Encoding encoding : kEncodings) {
              const TriangleMesh mesh = readPly("file", plyFile(encoding, brick, dialect));
              checkBrick(mesh, brick);
              CHECK(mesh.notes.empty());
            }
          }
        }
      }
    }
    checkText(readPly, plyFile(Encoding::text, brick), brick);
  }
}

TEST_CASE("fractions in a PLY text are doubles, binary floats are what they are", "[io]") {
  const Brick brick{{{{"-0.1", "0.7"}, {"1e-3", "0.3"}, {"2.6", "3.3"}}}};
  Dialect dialect;
  dialect.coordinate = "float";
  checkBrick(readPly("file", plyFile(Encoding::text, brick, dialect)), brick);
  const TriangleMesh mesh = readPly("file", plyFile(Encoding::big_endian, brick, dialect));
  for (int i = 0; i < 8; ++i) {
    CHECK(mesh.vertices[i] == brick.position(i).cast<float>().cast<double>());
  }
}

TEST_CASE("line ends of a PLY header before binary data", "[io]") {
  const Brick brick{{{{"10", "2570"}, {"-10", "10"}, {"1", "10"}}}};  // bytes that are line feeds
  for (const char* coordinate : {"uchar", "ushort", "int", "double"}) {
    for (const Encoding encoding : {Encoding::little_endian, Encoding::big_endian}) {
      Dialect dialect;
      dialect.coordinate = coordinate;
      const std::string file = plyFile(encoding, brick, dialect);
      const std::size_t body = file.find("end_header\n") + 11;
      const TriangleMesh expected = readPly("file", file);
      for (const char* end : {"\r\n", "\r"}) {
        const TriangleMesh mesh =
            readPly("file", withLineEnds(file.substr(0, body), end) + file.substr(body));
        CHECK(mesh.vertices == expected.vertices);
      }
    }
  }
}

TEST_CASE("triangle strips of a PLY file", "[io]") {
  std::mt19937 generator(50);
  const Brick brick = randomBrick(generator);
  std::vector<std::vector<int>> single;
  for (const Corners& q : kQuads) single.push_back(stripOf({q}, false));
  std::vector<int> ended = stripOf(kQuads, false);
  ended.push_back(-1);
  for (const Encoding encoding : kEncodings) {
    for (const char* type : {"int", "uint"}) {
      for (const auto& strips :
           {single, {stripOf(kQuads, false)}, {ended}, {stripOf(kQuads, true)}}) {
        const std::string file = stripFile(encoding, brick, type, strips);
        checkBrick(readPly("file", file), brick);
      }
    }
    for (const std::vector<int>& bad :
         {std::vector<int>{0, 1}, {0, 1, 2, -1, 3}, {0, 1, -2, 3}, {0, 1, 8}, {0, -1, 1, 2, 3}}) {
      checkRefused(readPly, stripFile(encoding, brick, "int", {ended, bad}), "'tristrips' 2 of 2");
    }
  }
  // -1 as it is written without a sign.
  checkBrick(readPly("file", replaced(stripFile(Encoding::text, brick, "uint", {ended}), " -1 ",
                                      " 4294967295 ")),
             brick);
}

TEST_CASE("elements of a PLY file that bear no surface, and those that may", "[io]") {
  const Brick brick = coarseBrick();
  const std::string file = plyFile(Encoding::text, brick);
  const auto with = [&](const std::string& element, const std::string& line) {
    return replaced(file, "end_header", "element " + element + "\nend_header") + line;
  };
  checkBrick(readPly("file", with("edge 1\nproperty int a\nproperty int b", "0 1")), brick);
  checkBrick(readPly("file", with("multi_texture_face 1\nproperty list uchar int vertex_indices",
                                  "3 0 1 2")),
             brick);
  checkBrick(readPly("file", with("cell 0\nproperty list uchar int vertex_indices", "")), brick);
  checkBrick(readPly("file", with("material 9999999999999", "")), brick);
  for (const char* name : {"trifans", "cell", "polygon", "tristrip"}) {
    checkRefused(readPly,
                 with(std::string(name) + " 1\nproperty list uchar int vertex_index", "3 0 1 2"),
                 std::string("'") + name + "' has vertex indices");
  }
  checkRefused(readPly, with("vertex 1\nproperty int x\nproperty int y\nproperty int z", "0 0 0"),
               "two elements 'vertex'");
  checkRefused(readPly, replaced(file, "vertex_indices", "corners"), "no list 'vertex_indices'");
  checkRefused(readPly, replaced(file, "double z", "double depth"), "needs the properties x, y");
  checkRefused(readPly, replaced(file, "double z", "double x"), "needs one number 'x'");
}

TEST_CASE("counts of a PLY file that are wrong", "[io]") {
  const Brick brick = coarseBrick();
  for (const Encoding encoding : kEncodings) {
    const std::string place = encoding == Encoding::text ? "line " : "byte ";
    for (const int wrong : {-8, -2, -1, 1, 2, 100, 2000000000}) {
      Dialect dialect;
      dialect.vertices_told += wrong;
      checkRefused(readPly, plyFile(encoding, brick, dialect), place);
      dialect = {};
      dialect.faces_told = std::max(0, dialect.faces_told + wrong);
      checkRefused(readPly, plyFile(encoding, brick, dialect), place);
    }
    const std::string file = plyFile(encoding, brick);
    for (std::size_t size = 0; size + 1 < file.size(); ++size) {
      if (encoding == Encoding::text && size + 2 >= file.size()) continue;
      CAPTURE(size);
      CHECK_THROWS_AS(readPly("file", file.substr(0, size)), FileError);
    }
    const TriangleMesh with_more = readPly("file", file + "\n~");
    checkBrick(with_more, brick);
    CHECK(with_more.notes.size() == 1);
  }
  const std::string file = plyFile(Encoding::text, brick);
  checkRefused(readPly, replaced(file, "4 0 2 3 1", "4 0 2 3 1 4"), "line 20: 'face' 1 of 6");
  checkRefused(readPly, replaced(file, "4 0 2 3 1", "3.5 0 2 3 1"), "line 20: 'face' 1 of 6");
  checkRefused(readPly, replaced(file, "4 0 2 3 1", "4 0 2 3 1.5"), "line 20: 'face' 1 of 6");
  checkRefused(readPly, replaced(file, "4 0 2 3 1", "2 0 2"), "line 20: 'face' 1 of 6");
  checkRefused(readPly, replaced(file, "4 0 2 3 1", "4 0 2 3 one"), "line 20: 'face' 1 of 6");
  checkRefused(readPly, replaced(file, "-0.5 -1 0.25", "-0.5 nan 0.25"), "line 12: a vertex has");
}
