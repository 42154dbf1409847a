// SPDX-License-Identifier: MIT
// What a scene file may say, and the error it gets where it says something else.
#include "scene/xml_reader.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "scene_files.hpp"

using namespace std::string_view_literals;
using namespace scene_test;

TEST_CASE("scene xml: objects nest in the order of the file and carry their types") {
  const Scene scene = read(R"(<shape type="sphere" id="ball">
      <bsdf type="diffuse"/>
      <!-- a comment -->
    </shape>
    <emitter type="constant"/>)");
  CHECK(scene->element() == "scene");
  const auto all = scene->children();
  REQUIRE(all.size() == 2);
  CHECK(all[0]->element() == "shape");
  CHECK(all[0]->type() == "sphere");
  CHECK(all[0]->id() == "ball");
  CHECK(all[0]->location().line == 2);
  CHECK(all[0]->children("bsdf").at(0)->type() == "diffuse");
  CHECK(all[1]->location().line == 6);
}

TEST_CASE("scene xml: a spectrum with a type is a texture") {
  const Scene scene =
      read(R"(<bsdf type="diffuse"><spectrum type="uniform" name="reflectance"/></bsdf>)");
  const auto texture = scene->children("bsdf").at(0)->texture("reflectance");
  REQUIRE(texture);
  CHECK(texture->element() == "texture");
  CHECK(texture->type() == "uniform");
}

TEST_CASE("scene xml: references are one object, also before what they name and by alias") {
  const Scene scene = read(R"(<shape type="a"><ref id="m"/></shape>
    <bsdf type="diffuse" id="m"/>
    <alias id="m" as="n"/>
    <shape type="b"><ref name="skin" id="n"/></shape>)");
  const auto material = scene->children("bsdf").at(0);
  const auto shapes = scene->children("shape");
  CHECK(shapes[0]->children("bsdf").at(0) == material);
  CHECK(shapes[1]->child("skin", "bsdf") == material);
}

TEST_CASE("scene xml: an unknown id is an error that lists the near ones") {
  CHECK_MESSAGE_HAS(read_error("<bsdf type='diffuse' id='gold'/><bsdf type='diffuse' id='glass'/>\n"
                               "<shape type='sphere'>\n<ref id='glas'/></shape>"),
                    "scene.xml:4: ", "unknown id \"glas\"", "allowed: glass, gold");
  CHECK_MESSAGE_HAS(read_error("<ref id='a'/>"), "allowed: none");
}

TEST_CASE("scene xml: an object that refers to itself is an error") {
  CHECK_MESSAGE_HAS(
      read_error("<bsdf type='twosided' id='a'>\n<bsdf type='b'><ref id='a'/></bsdf></bsdf>"),
      "scene.xml:3: ", "\"a\"", "cycle");
  CHECK_MESSAGE_HAS(read_error("<bsdf type='x' id='a'><ref id='b'/></bsdf>"
                               "<bsdf type='x' id='b'><ref id='a'/></bsdf>"),
                    "cycle");
}

TEST_CASE("scene xml: a long chain of references is refused and doesn't overflow the stack") {
  std::string chain;
  for (int i = 0; i < 20000; ++i) {
    chain += "<bsdf type='x' id='n" + std::to_string(i) + "'><ref id='n" + std::to_string(i + 1) +
             "'/></bsdf>\n";
  }
  CHECK_MESSAGE_HAS(read_error(chain + "<bsdf type='x' id='n20000'/>"),
                    "references nested more than 64 levels deep");
}

TEST_CASE("scene xml: a chain declared from its end is refused just as well") {
  std::string chain = "<bsdf type='x' id='n0'/>\n";
  for (int i = 1; i < 100; ++i) {
    chain += "<bsdf type='x' id='n" + std::to_string(i) + "'><ref id='n" + std::to_string(i - 1) +
             "'/></bsdf>\n";
  }
  CHECK_MESSAGE_HAS(read_error(chain), "references nested more than 64 levels deep");
}

TEST_CASE("scene xml: ids are unique, and aliases need a known id and a free one") {
  CHECK_MESSAGE_HAS(read_error("<bsdf type='a' id='m'/>\n<bsdf type='b' id='m'/>"),
                    "scene.xml:3: ", "id \"m\" is given twice", "first in line 2", "each id once");
  CHECK_MESSAGE_HAS(read_error("<alias id='m' as='n'/>"), "scene.xml:2: ", "unknown id \"m\"");
  CHECK_MESSAGE_HAS(read_error("<bsdf type='a' id='m'/><alias id='m' as='m'/>"), "\"m\" is taken");
}

TEST_CASE("scene xml: parameters come from defaults and the command line, which wins") {
  const std::string content = R"(<default name="w" value="3"/><default name="ab" value="$w.5"/>
    <shape type="sphere"><float name="x" value="$ab"/><string name="s" value="\$w is $w"/></shape>)";
  const auto shape = [&](const Definitions& d) {
    return read(content, d)->children("shape").at(0);
  };
  CHECK(shape({})->number("x") == 3.5);
  CHECK(shape({})->string("s") == "$w is 3");
  CHECK(shape({{"w", "7"}})->number("x") == 7.5);
}

TEST_CASE("scene xml: an undefined parameter is an error that lists the defined ones") {
  CHECK_MESSAGE_HAS(read_error("<default name='angle' value='1'/>\n"
                               "<shape type='sphere'><float name='r' value='$angel'/></shape>"),
                    "scene.xml:3: ", "undefined parameter \"$angel\"", "allowed: angle");
  CHECK_MESSAGE_HAS(read_error("<string name='s' value='a $'/>"), "undefined parameter \"$\"",
                    "allowed: none");
}

TEST_CASE("scene xml: a definition the scene has no use for is an error that lists the known") {
  CHECK_MESSAGE_HAS(read_error("<default name='angle' value='1'/>", {{"angel", "2"}}),
                    "scene.xml: ", "-D angel=2", "allowed: angle");
  CHECK(read("<string name='s' value='$t'/>", {{"t", "x"}})->string("s") == "x");
  CHECK_MESSAGE_HAS(read_error("", {{"a b", "2"}}), "\"a b=2\"", "letters, digits and underscores");
  CHECK_MESSAGE_HAS(read_error("<default name='a-b' value='1'/>"), "scene.xml:2: ", "underscores");
}

TEST_CASE("scene xml: an include brings in another file's objects, with that file's lines") {
  const Folder folder;
  folder.write("parts/ball.xml", in_scene("\n<shape type='sphere' id='s'><float name='radius' "
                                          "value='$r'/><string name='f' value='m.obj'/></shape>"));
  folder.write("parts/m.obj", "");
  folder.write("parts/glass.xml", "<bsdf version='3.5.2' type='dielectric' id='glass'/>");
  const auto path = folder.write(
      "scene.xml", in_scene("<default name='r' value='2'/><default name='part' value='ball'/>\n"
                            "<include filename='parts/$part.xml'/>\n"
                            "<shape type='cube'><include filename='parts/glass.xml'/></shape>"));
  const Scene scene = renderer::read_scene(path, {});
  const auto shapes = scene->children("shape");
  REQUIRE(shapes.size() == 2);
  CHECK(shapes[0]->number("radius") == 2);
  CHECK(shapes[0]->location().file == (folder.path() / "parts/ball.xml").string());
  CHECK(shapes[0]->location().line == 3);
  CHECK(shapes[0]->file("f") == folder.path() / "parts/m.obj");
  CHECK(shapes[1]->children("bsdf").at(0)->type() == "dielectric");
}

TEST_CASE("scene xml: what is wrong with an include is told") {
  const Folder folder;
  const auto error = [&](std::string_view content) {
    const auto path = folder.write("scene.xml", in_scene(content));
    return error_of([&] { renderer::read_scene(path, {}); });
  };
  CHECK_MESSAGE_HAS(error("\n<include filename='none.xml'/>"), "scene.xml:3: ", "none.xml",
                    "no such file");
  CHECK_MESSAGE_HAS(error("<include filename='scene.xml'/>"), "scene.xml:2: ", "includes itself");
  folder.write("bad.xml", "<scene version='3.0.0'>\n\n<oops/></scene>");
  CHECK_MESSAGE_HAS(error("<include filename='bad.xml'/>"), "bad.xml:3: ", "<oops>");
  folder.write("other.xml", "<float version='3.0.0'/>");
  CHECK_MESSAGE_HAS(error("<include filename='other.xml'/>"), "other.xml:1: ", "allowed: scene");
  for (int i = 0; i < 20; ++i) {
    folder.write(std::string("n").append(std::to_string(i)).append(".xml"),
                 in_scene("<include filename='n" + std::to_string(i + 1) + ".xml'/>"));
  }
  folder.write("n20.xml", in_scene(""));
  CHECK_MESSAGE_HAS(error("<include filename='n0.xml'/>"), "more than 15 files deep");
}

TEST_CASE("scene xml: path adds a folder in which files are looked up") {
  const Folder folder;
  folder.write("models/m.ply", "");
  const auto read_file = [&](std::string_view value) {
    const auto path = folder.write(
        "scene.xml", in_scene("<path value='models'/>\n<shape type='ply'><string name='filename' "
                              "value='" +
                              std::string(value) + "'/></shape>"));
    return renderer::read_scene(path, {})->children("shape").at(0)->file("filename");
  };
  CHECK(read_file("m.ply") == folder.path() / "models/m.ply");
  CHECK(read_file("none.ply") == folder.path() / "none.ply");
  CHECK(read_file("/m.ply") == "/m.ply");
  CHECK_MESSAGE_HAS(read_error("<path value='none'/>"), "scene.xml:2: ", "no such folder");
}

TEST_CASE("scene xml: the root is a scene of version 3") {
  const Folder folder;
  const auto error = [&](std::string_view text) {
    const auto path = folder.write("scene.xml", text);
    return error_of([&] { renderer::read_scene(path, {}); });
  };
  CHECK(error("<scene version='3.6.4'/>") == "no error");
  CHECK_MESSAGE_HAS(error("<scene version='2.1.0'/>"), "scene.xml:1: ", "\"2.1.0\"",
                    "allowed: 3.x.y");
  CHECK_MESSAGE_HAS(error("<scene version='3.0'/>"), "\"3.0\"", "allowed: 3.x.y");
  CHECK_MESSAGE_HAS(error("<scene version='3.a.1'/>"), "allowed: 3.x.y");
  CHECK_MESSAGE_HAS(error("<scene/>"), "\"version\" is missing");
  CHECK_MESSAGE_HAS(error("\n<bsdf version='3.0.0' type='a'/>"), "scene.xml:2: ", "<bsdf>",
                    "allowed: <scene");
}

TEST_CASE("scene xml: a file that isn't a well-formed XML file is an error with its line") {
  const Folder folder;
  const auto error = [&](std::string_view text) {
    const auto path = folder.write("scene.xml", text);
    return error_of([&] { renderer::read_scene(path, {}); });
  };
  CHECK_MESSAGE_HAS(error(""), "scene.xml:1: ", "empty");
  CHECK_MESSAGE_HAS(error(" \n "), "empty");
  CHECK_MESSAGE_HAS(error("<!-- a -->"), "no element");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'>\n<bsdf type='a'>\n"), "scene.xml:", "malformed",
                    "ends too early");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'>\n<bsdf type='a'>\n</shape></scene>"),
                    "scene.xml:3: ", "malformed", "mismatch");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'>\n<bsdf type=a/></scene>"),
                    "scene.xml:2: ", "malformed");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'/>\n<scene version='3.0.0'/>"),
                    "scene.xml:2: ", "second root");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'/>\nmore"), "scene.xml:2: ", "\"more\"");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'>\n\n<!-- \n -->stray</scene>"),
                    "scene.xml:4: ", "stray text \"stray\"");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'>\n<![CDATA[x]]></scene>"),
                    "scene.xml:2: ", "\"x\"");
  CHECK_MESSAGE_HAS(error("<scene version='3.0.0'>\n\0</scene>"sv), "scene.xml:2: ", "zero byte");
}

TEST_CASE("scene xml: lines are counted with any line ending") {
  CHECK_MESSAGE_HAS(read_error("\r\n\r\n<oops/>"), "scene.xml:4: ");
  CHECK_MESSAGE_HAS(read_error("\r\r<oops/>"), "scene.xml:4: ");
}

TEST_CASE("scene xml: document types and entities are refused, character references are not") {
  const Folder folder;
  const auto path =
      folder.write("scene.xml", "<!DOCTYPE scene [<!ENTITY a 'b'>]>\n<scene version='3.0.0'/>");
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(path, {}); }), "scene.xml:1: ", "DOCTYPE");
  CHECK_MESSAGE_HAS(read_error("<!-- R&D -->\n<string name='s' value='&lol;'/>"),
                    "scene.xml:3: ", "\"&lol;\"", "allowed: &amp;");
  CHECK_MESSAGE_HAS(read_error("<string name='s' value='a & b'/>"), "unknown entity");
  CHECK(read("<string name='s' value='&lt;&#65;&#x42;&amp;'/>")->string("s") == "<AB&");
}

TEST_CASE("scene xml: a file that can't be read is an error that says why") {
  const Folder folder;
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(folder.path() / "none.xml", {}); }),
                    "none.xml: no such file");
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(folder.path(), {}); }), "is a folder");
  const auto pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(pipe, {}); }), "not a regular file");
  const auto huge = folder.write("huge.xml", "");
  std::filesystem::resize_file(huge, (std::uintmax_t{1} << 30) + 1);
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(huge, {}); }), "huge.xml: ", "1073741825",
                    "at most 1073741824");
}

TEST_CASE("scene xml: nesting is limited and a hundred thousand levels are survived") {
  const auto nested = [](int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += "<bsdf type='twosided'>";
    for (int i = 0; i < levels; ++i) text += "</bsdf>";
    return text;
  };
  CHECK(read_error(nested(63)) == "no error");
  CHECK_MESSAGE_HAS(read_error(nested(64)), "scene.xml:2: ", "64 levels");
  CHECK_MESSAGE_HAS(read_error(nested(100000)), "64 levels");
}

TEST_CASE("scene xml: unknown elements and attributes are errors that list what is allowed") {
  CHECK_MESSAGE_HAS(read_error("<shap type='a'/>"), "scene.xml:2: ", "<shap>", "unknown element",
                    "bsdf, emitter", "shape", "transform", "include");
  CHECK_MESSAGE_HAS(read_error("<shape typ='a'/>"), "unknown attribute \"typ\"",
                    "allowed: type, id, name");
  CHECK_MESSAGE_HAS(read_error("<shape/>"), "\"type\" is missing");
  CHECK_MESSAGE_HAS(read_error("<shape type='a' type='b'/>"), "\"type\" is given twice");
  CHECK_MESSAGE_HAS(read_error("<float name='a'/>"), "<float name=\"a\">", "\"value\" is missing");
  CHECK_MESSAGE_HAS(read_error("<float value='1'/>"), "\"name\" is missing");
  CHECK_MESSAGE_HAS(read_error("<float name='' value='1'/>"), "empty name");
  CHECK_MESSAGE_HAS(read_error("<float name='a' value='1' unit='m'/>"), "\"unit\"",
                    "allowed: name, value");
  CHECK_MESSAGE_HAS(read_error("<shape type=''/>"), "empty type");
  CHECK_MESSAGE_HAS(read_error("<shape type='a'><scene version='3.0.0'/></shape>"), "<scene>");
  CHECK_MESSAGE_HAS(read_error("<translate x='1'/>"), "outside of a <transform>");
  CHECK_MESSAGE_HAS(read_error("<float name='a' value='1'>\n<float name='b' value='2'/></float>"),
                    "scene.xml:3: ", "inside of <float>");
  CHECK_MESSAGE_HAS(read_error("<float name='a' value='1'>2</float>"), "stray text \"2\"");
  CHECK_MESSAGE_HAS(read_error("<float name='a' value='1'/>\n<rgb name='a' value='2'/>"),
                    "scene.xml:3: ", "\"a\" is given twice", "first in line 2");
  CHECK_MESSAGE_HAS(read_error("<bsdf type='x' name='a'/>\n<rgb name='a' value='2'/>"),
                    "scene.xml:3: ", "\"a\" is given twice");
}
