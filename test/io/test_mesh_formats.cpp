// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// One brick in the dialects of many programs: it is the same to the last bit, or refused by line.
#include "io/mesh_formats.h"

#include <cmath>
#include <cstring>

#include "brick.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

std::string objVertices(const Brick& brick, const std::string& rest = "", const char* blank = " ") {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += std::string("v") + blank + brick.corner(i, blank) + rest + "\n";
  return text;
}

std::string objFaces(const std::vector<Corners>& faces, int first, const std::string& attributes,
                     const std::string& blank = " ") {
  std::string text;
  for (const Corners& face : faces) {
    text += "f";
    for (const int corner : face) text += blank + std::to_string(corner + first) + attributes;
    text += "\n";
  }
  return text;
}

std::string stlText(const Brick& brick, bool in_capitals, const std::string& name = "a b") {
  std::string text = "solid " + name + "\n";
  for (const Corners& t : triangles()) {
    text += " facet normal 0 0 nan\n\touter loop\n";
    for (const int corner : t) text += "  vertex\t" + brick.corner(corner, "\t") + "\n";
    text += " endloop\n endfacet\n";
  }
  text += "endsolid " + name + "\n";
  if (in_capitals) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
  }
  return text;
}

std::string stlBinary(const Brick& brick, const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(std::uint32_t{12});
  for (const Corners& t : triangles()) {
    for (int k = 0; k < 3; ++k) append(std::nanf(""));
    for (const int corner : t) {
      for (int k = 0; k < 3; ++k) append(static_cast<float>(brick.position(corner)[k]));
    }
    append(std::uint16_t{0x8123});
  }
  return bytes;
}

}  // namespace

TEST_CASE("an OBJ file in its dialects", "[io]") {
  std::mt19937 generator(47);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const Brick brick = randomBrick(generator);
    const std::string vertices = objVertices(brick);
    for (const auto& faces : {kQuads, triangles()}) {
      for (const char* attributes : {"", "/1", "//2", "/1/2", "/", "//"}) {
        checkText(readObj, vertices + objFaces(faces, 1, attributes), brick);
      }
      checkText(readObj, vertices + objFaces(faces, -8, "/-1/-1"), brick);
      checkText(readObj, objFaces(faces, 1, "") + vertices, brick);
      const std::string plain = objFaces(faces, 1, "");
      for (const char* rest : {" 1", " 1.0 # a", " 0.1 0.2 0.3", " nan 0 0", "\t#c"}) {
        checkText(readObj, objVertices(brick, rest, "\t") + plain, brick);
      }
      checkText(readObj, objVertices(brick, "", " \\\n ") + objFaces(faces, 1, "", " \\\n"), brick);
      checkText(readObj, objVertices(brick, "", "  \\ \n") + plain, brick);
    }
  }
}

TEST_CASE("what else an OBJ file may hold", "[io]") {
  const Brick brick = coarseBrick();
  const std::string vertices = objVertices(brick);
  const std::string faces = objFaces(kQuads, 1, "");
  for (const char* line :
       {"# a comment \\", "#\\", "   # \\ ", "o parts\\head\\", "usemtl C:\\steel\\", "g a b #c",
        "mtllib K\xF6rper.mtl", "s off", "s 1", "vt 0 1 \\\n 0", "vn 0 0 1", "vp 0 1", "p 1 2",
        "l 1 2 3", "l 1 \\\n2 \\\n 3", "vc 1 2 3", "cstype bspline", "lod 1",
        "v\\t # of no statement: x"}) {
    CAPTURE(line);
    const std::size_t notes = line[0] == 'v' && line[1] == '\\' ? 1 : 0;
    checkText(readObj, std::string(line) + "\n" + vertices + faces, brick, notes);
    checkText(readObj, vertices + line + "\n" + faces, brick, notes);
    checkText(readObj, vertices + faces + line, brick, notes);
  }
  for (const char* line : {"6540 2180", "Exported by hand", "vx 1 2", "element 3"}) {
    checkText(readObj, line + ("\n" + vertices) + faces, brick, 1);
  }
  const std::string weighted = "v 2 4 6 2\nv 3 0 0 1\nv 0 1.5 0 0.5\nf 1 2 3\n";
  const TriangleMesh mesh = readObj("file", weighted);
  CHECK(mesh.vertices[0] == fcl::Vector3d(1, 2, 3));
  CHECK(mesh.vertices[2] == fcl::Vector3d(0, 3, 0));
}

TEST_CASE("what an OBJ file is refused for, by its line", "[io]") {
  const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* number : {"1.#QNAN", "0x10", "0,5", "1e", "--1", "1.0f", "1d3", "\xC3\xA9"}) {
    checkRefused(readObj, good + "v 0 0 " + number + "\nf 1 2 3\n", "line 4: '");
    checkRefused(readObj, good + "v " + number + " \\\n 0 0\nf 1 2 3\n", "' is not a number");
  }
  for (const char* number : {"nan", "-inf", "1e999", "1e200"}) {
    checkRefused(readObj, good + "v 0 0 " + number + "\nf 1 2 3\n", "line 4: a vertex has");
  }
  for (const char* line : {"v",
                           "v 1",
                           "v 1 2",
                           "v 1 2 # 3",
                           "v 1 2 3 4 5",
                           "v 1 2 3 4 5 6 7",
                           "v 1 2 3 0",
                           "v 1 2 3 x",
                           "f",
                           "f 1 2",
                           "f 1 2 0",
                           "f 1 2 4",
                           "f 1 2 -4",
                           "f 1 2 3.5",
                           "f 1,2,3",
                           "f 1 2 x",
                           "f / 1 2",
                           "f 1 2 99999999999999999999",
                           "curv 0 1 1 2",
                           "surf 0 1 0 1 1 2 3",
                           "call other.obj",
                           "F 1 2 3",
                           "V 1 2 3",
                           "face 1/1 2/2 3/3"}) {
    checkRefused(readObj, good + line + "\nf 1 2 3\n", "line 4: ");
  }
  checkRefused(readObj, good + "v 1 1 0\nf 1 4 2 3\n", "line 5: a face of 4 corners crosses");
  checkRefused(readObj, std::string("v 0 0 0\n\0v 1 0 0\n", 17), "not a text");
}

TEST_CASE("an OFF file in its dialects", "[io]") {
  std::mt19937 generator(48);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const Brick brick = randomBrick(generator);
    const auto file = [&](const std::string& header, const char* of_vertex, const char* of_face) {
      std::string text = header;
      for (int i = 0; i < 8; ++i) text += brick.corner(i) + of_vertex + "\n";
      for (const Corners& q : kQuads) {
        text += "4";
        for (const int corner : q) text += " " + std::to_string(corner);
        text += std::string(of_face) + "\n";
      }
      return text;
    };
    checkText(readOff, file("OFF\n8 6 0\n", "", ""), brick);
    checkText(readOff, file("OFF 8 6 12\n", " # a", " 255 0 0"), brick);
    checkText(readOff, file(" \tOFF8 6\n", " ", " 0.1 0.2 0.3 1"), brick);
    checkText(readOff, file("# a\nCOFF # b\n\n# c\n 8 6 12\n", " 255 0 0 255", " 3"), brick);
    checkText(readOff, file("NOFF\n8 6 0\n", " 0 0 1", ""), brick);
    checkText(readOff, file("STCNOFF\n8 6 0\n", " 0 0 1 0.1 0.2 0.3 1 0.5 0.5", ""), brick);
    checkText(readOff, file("4OFF\n8 6 0\n", " 1", ""), brick);
    checkText(readOff, file("nOFF\n3\n8 6 0\n", "", ""), brick);
    checkText(readOff, file("nOFF 3\n8 6 0\n", "", ""), brick);
    checkText(readOff, file("OFF\n8 6 0\n", "", "") + "# the end\n", brick);
    checkText(readOff, file("OFF\n8 6 0\n", "", "") + "the end\n", brick, 1);
  }
}

TEST_CASE("what an OFF file is refused for, by its line", "[io]") {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  checkRefused(readOff, "OFF\n3 2 0\n" + body, "ends before its face 2 of 2");
  checkRefused(readOff, "OFF\n4 1 0\n" + body, "ends before its face 1 of 1");
  checkRefused(readOff, "OFF\n2 1 0\n" + body, "line 5: a face has 0 corners");
  checkRefused(readOff, "OFF\n3 1 0\n" + body + "3 0 2 1\n", "line 7: one more face");
  checkRefused(readOff, "OFF\n3 0 0\n" + body, "line 6: one more face");
  checkRefused(readOff, "OFF BINARY\n", "line 1: a binary OFF");
  checkRefused(readOff, "nOFF\n4\n3 1 0\n" + body, "line 2: vertices of '4' dimensions");
  checkRefused(readOff, "4OFF\n3 1 0\n" + body,
               "line 3: a vertex needs three numbers and a weight");
  checkRefused(readOff, "xOFF\n3 1 0\n" + body, "line 1: 'x' is not a prefix");
  checkRefused(readOff, body, "line 1: an OFF file begins with 'OFF'");
  for (const char* vertex : {"0 0", "0 0 x", "0 0 1,5", "0 0 0x1", "0 0 1.#INF"}) {
    checkRefused(readOff, "OFF\n3 1 0\n" + replaced(body, "1 0 0", vertex), "line 4: ");
  }
  for (const char* face : {"2 0 1", "3 0 1", "3 0 1 3", "3 0 1 -1", "3 0 1 1.5", "-3 0 1 2", "x"}) {
    checkRefused(readOff, "OFF\n3 1 0\n" + replaced(body, "3 0 1 2", face), "line 6: ");
  }
}

TEST_CASE("a text STL file in its dialects", "[io]") {
  std::mt19937 generator(49);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const Brick brick = randomBrick(generator);
    for (const bool in_capitals : {false, true}) {
      for (const char* name : {"", "part 1", "solid facet vertex 1 2 3", "K\xF6rper"}) {
        checkText(readStl, stlText(brick, in_capitals, name), brick);
      }
      const std::string text = stlText(brick, in_capitals);
      checkText(readStl, "\n  \n" + text + "solid empty\nendsolid\n", brick);
      checkText(readStl, text + "solid b\nendsolid b\n\x1a", brick, 1);
      checkText(readStl, text + "made by hand\nand by night\n", brick, 1);
      checkBrick(readStl("file", text + std::string(100, '\0')), brick);
    }
    // Two solids, of which each has a part of the faces.
    checkText(readStl,
              replaced(stlText(brick, false), " endfacet\n", " endfacet\nendsolid a b\nsolid c\n"),
              brick);
  }
}

TEST_CASE("what a text STL file is refused for, by its line", "[io]") {
  const std::string text = stlText(coarseBrick(), false);
  checkRefused(readStl, replaced(text, "endsolid", "endsolit"), "ends before 'endsolid'");
  checkRefused(readStl, replaced(text, " endfacet\n", ""), "line 8: a facet begins inside a facet");
  checkRefused(readStl, replaced(text, " facet normal 0 0 nan\n", ""), "line 2: 'outer' outside");
  checkRefused(readStl, replaced(text, "  vertex", "  vertexx"),
               "line 4: 'vertexx' inside a facet");
  checkRefused(readStl, replaced(text, "  vertex", "  vertex\t1\t2\t3\n  vertex"),
               "line 7: a facet has more than 3 vertices");
  checkRefused(readStl, replaced(text, "vertex\t-1\t-0.5\t0.25", ""), "line 8: a facet has 2");
  for (const char* vertex : {"0\t1", "x\t0\t0", "0,5\t0\t0", "0\t0\t1.#IND"}) {
    checkRefused(readStl, replaced(text, "-1\t-0.5\t0.25", vertex), "line 4: ");
  }
}

TEST_CASE("a binary STL file and what may stand around it", "[io]") {
  const Brick brick = coarseBrick();
  for (const char* header : {"", "solid of no text", "facet", "COLOR=abcd"}) {
    const std::string bytes = stlBinary(brick, header);
    const TriangleMesh mesh = readStl("file", bytes);
    checkBrick(mesh, brick);
    CHECK(mesh.notes.empty());
    for (const std::string& behind :
         {std::string("\r\n"), std::string(1, '\0'), std::string(49, 'x'), std::string(50, '\0'),
          std::string(512, '\0'),
          std::string("made by a program that signs what it writes, 2026")}) {
      const TriangleMesh with_more = readStl("file", bytes + behind);
      checkBrick(with_more, brick);
      REQUIRE(with_more.notes.size() == 1);
      CHECK(with_more.notes[0].find("the file has " + std::to_string(684 + behind.size())) !=
            std::string::npos);
    }
    // One triangle more than the header tells, or another file behind this one.
    for (std::string more : {bytes + bytes.substr(84, 50), bytes + bytes}) {
      for (const char* behind : {"", "\n"}) checkRefused(readStl, more + behind, "claims 12");
    }
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      CHECK_THROWS_AS(readStl("file", bytes.substr(0, size)), FileError);
    }
  }
  std::string bytes = stlBinary(brick, "");
  std::memset(bytes.data() + 84 + 50 + 12, 0xFF, 4);
  checkRefused(readStl, bytes, "byte 134: a vertex has a coordinate that is not finite");
}

TEST_CASE("every prefix of an OFF or STL text is refused", "[io]") {
  const std::string off = "OFF # a\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  const std::string stl = stlText(coarseBrick(), false, "");
  for (std::size_t size = 0; size < off.size(); ++size) {
    CAPTURE(size);
    CHECK_THROWS_AS(readOff("file", off.substr(0, size)), FileError);
  }
  for (std::size_t size = 0; size < stl.find("endsolid") + 8; ++size) {
    CAPTURE(size);
    CHECK_THROWS_AS(readStl("file", stl.substr(0, size)), FileError);
  }
}
