// SPDX-License-Identifier: MIT
// Bitmaps and checkerboards: their values, where on a surface they are, and what is refused.
#include <doctest/doctest.h>

#include <bit>

#include "io/png.hpp"
#include "picture_files.hpp"
#include "textures/read_texels.hpp"

using namespace render_test;
using renderer::Bitmap;
using renderer::Hit;
using renderer::Rgb;
using renderer::Texels;
using renderer::Texture;
using renderer::Vec2;
using renderer::Vec3;

namespace {

/// Texel (x, y) is 10 y + x in red, and other numbers in green and blue.
Texels numbered(int width, int height) {
  Texels t{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      t.values.emplace_back(10 * y + x, 0.5f * static_cast<float>(x * x), 1 - y);
  return t;
}

float red(const Bitmap& bitmap, float u, float v) { return bitmap.value({u, v})[0]; }

Hit hit_of(const renderer::Scene& scene, const Vec3& from, const Vec3& to) {
  Hit hit;
  REQUIRE(scene.intersect({from, glm::normalize(to - from), renderer::infinity}, hit));
  return hit;
}

const std::string some_meter = meter({0, 0, 9}, {0, 0, 0}, {1, 0, 0});

std::string textured(const std::string& texture) { return bsdf("diffuse", texture); }

/// The reflectance of the diffuse surface that is seen from one point at another.
double seen(const std::string& shape, const Vec3& from, const Vec3& at) {
  const auto scene = build(some_meter + shape);
  Hit hit = hit_of(scene, from, at);
  const renderer::Bsdf& surface = scene.shapes[hit.shape].material.facing(hit, from - at);
  const Rgb value =
      surface.value<malus::Unpolarized<Rgb>>(hit, hit.normal, glm::normalize(from - at)).m00;
  return static_cast<double>(value[0]) * pi;
}

}  // namespace

TEST_CASE("texture: bilinear values run from texel centre to texel centre") {
  const Bitmap b(numbered(4, 3), Bitmap::Filter::bilinear, Bitmap::Wrap::clamp);
  CHECK(red(b, 0.125f, 0.5f / 3) == doctest::Approx(0));
  CHECK(red(b, 0.375f, 1.5f / 3) == doctest::Approx(11));
  CHECK(red(b, 0.5f, 0.5f) == doctest::Approx(11.5));
  CHECK(red(b, 0.45f, 0.4f) == doctest::Approx(10 * 0.7 + 1.3));
  CHECK(b.value({0.75f, 0.5f})[1] == doctest::Approx(0.5 * (0.5 * 4 + 0.5 * 9)));
}

TEST_CASE(
    "texture: outside of the unit square a bitmap repeats, is mirrored or stays at its edge") {
  const auto nearest = [](Bitmap::Wrap wrap) {
    return Bitmap(numbered(4, 3), Bitmap::Filter::nearest, wrap);
  };
  struct Case {
    float u, v;
    int repeated, mirrored, clamped;
  };
  // Columns and rows as Mitsuba 3.9 gives them.
  for (const Case& c :
       {Case{0.1f, 0.1f, 0, 0, 0}, Case{1.1f, 0.1f, 0, 3, 3}, Case{-0.1f, 0.1f, 3, 0, 0},
        Case{2.1f, 0.1f, 0, 0, 3}, Case{0.1f, -0.1f, 20, 0, 0}, Case{-1.1f, -0.1f, 23, 3, 0},
        Case{0.1f, 1.9f, 20, 0, 20}}) {
    CAPTURE(c.u);
    CAPTURE(c.v);
    CHECK(red(nearest(Bitmap::Wrap::repeat), c.u, c.v) == static_cast<float>(c.repeated));
    CHECK(red(nearest(Bitmap::Wrap::mirror), c.u, c.v) == static_cast<float>(c.mirrored));
    CHECK(red(nearest(Bitmap::Wrap::clamp), c.u, c.v) == static_cast<float>(c.clamped));
  }
  const Bitmap b(numbered(4, 3), Bitmap::Filter::bilinear, Bitmap::Wrap::repeat);
  CHECK(red(b, 0, 0.5f) ==
        doctest::Approx(10 + 1.5));  // half of the last column, half of the first
  for (const float far : {1e9f, -1e30f, renderer::infinity, std::nanf("")})
    for (const auto wrap : {Bitmap::Wrap::repeat, Bitmap::Wrap::mirror, Bitmap::Wrap::clamp})
      CHECK(red(nearest(wrap), far, far) <= 23);
}

TEST_CASE(
    "texture: the gradient is the derivative of the luminance, however the picture is turned") {
  const Texture t(Bitmap(numbered(4, 3), Bitmap::Filter::bilinear, Bitmap::Wrap::repeat),
                  {glm::mat2(1.7f, 0.6f, -0.4f, 2.1f), {0.3f, 0.1f}});
  const auto height = [&](float u, float v) {
    return static_cast<double>(renderer::luminance(t.value({u, v})));
  };
  constexpr float h = 1e-3f;
  for (const Vec2 at : {Vec2(0.2f, 0.7f), Vec2(0.61f, 0.13f), Vec2(0.9f, 0.4f)}) {
    const Vec2 g = t.luminance_gradient(at);
    CHECK(
        g.x ==
        doctest::Approx((height(at.x + h, at.y) - height(at.x - h, at.y)) / (2 * h)).epsilon(5e-3));
    CHECK(
        g.y ==
        doctest::Approx((height(at.x, at.y + h) - height(at.x, at.y - h)) / (2 * h)).epsilon(5e-3));
  }
}

TEST_CASE("texture: files of integers are sRGB unless raw, floats and rows are as they are") {
  const Folder folder;
  renderer::Picture png(2, 2);
  png.set(0, 0, {128 / 255.0f, 1, 0});
  png.set(1, 1, {0, 10 / 255.0f, 0});
  renderer::write_png(folder.path() / "a.png", png);
  const Texels decoded = renderer::read_texels(folder.path() / "a.png", false);
  CHECK(decoded.at(0, 0)[0] == doctest::Approx(0.2158605));  // IEC 61966-2-1
  CHECK(decoded.at(0, 0)[1] == 1);
  CHECK(decoded.at(1, 1)[1] == doctest::Approx(10 / 255.0 / 12.92));
  CHECK(decoded.at(0, 1)[1] == 0);
  CHECK(renderer::read_texels(folder.path() / "a.png", true).at(0, 0)[0] ==
        doctest::Approx(128 / 255.0));

  const std::string exr =
      picture(folder, "a.exr", 3, 2, [](int x, int y) { return glm::vec3(x, y, 7.5f); });
  CHECK(renderer::read_texels(exr, false).at(2, 1) == Rgb(2.0f, 1.0f, 7.5f));

  // One pixel wide, so in no runs: mantissas and the exponent's 128 + 2.
  const auto hdr =
      folder.write("a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n") +
                                "\x80\x40\x20\x82");
  CHECK(renderer::read_texels(hdr, false).at(0, 0) == Rgb(2.0f, 1.0f, 0.5f));
  // Red in a run of 8, green in two, blue and exponent in bytes of their own.
  const auto runs = folder.write(
      "b.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\x02\x02\0\x08\x88\x10"
                           "\x83\x20\x85\x40\x08\1\2\3\4\5\6\7\x08\x88\x88",
                           66));
  const Texels eight = renderer::read_texels(runs, false);
  CHECK(eight.at(2, 0) == Rgb(16.0f, 32.0f, 3.0f));
  CHECK(eight.at(7, 0) == Rgb(16.0f, 64.0f, 8.0f));
}

TEST_CASE("texture: the first row is at v = 0 of a rectangle, as in Mitsuba") {
  const Folder folder;
  const std::string name = picture(folder, "a.exr", 2, 2, [](int x, int y) {
    return glm::vec3(0.1f + 0.2f * static_cast<float>(x) + 0.4f * static_cast<float>(y));
  });
  const auto at = [&](float x, float y, const std::string& more) {
    const std::string shape =
        "<shape type=\"rectangle\">" + textured(bitmap("reflectance", name, more)) + "</shape>";
    return seen(shape, {0.1f, 0.2f, 3}, {x, y, 0});
  };
  const std::string nearest = text_value("filter_type", "nearest");
  CHECK(at(-0.5f, -0.5f, nearest) == doctest::Approx(0.1));
  CHECK(at(0.5f, -0.5f, nearest) == doctest::Approx(0.3));
  CHECK(at(-0.5f, 0.5f, nearest) == doctest::Approx(0.5));
  CHECK(at(0.5f, 0.5f, nearest) == doctest::Approx(0.7));
  CHECK(at(0, 0.25f, "") == doctest::Approx(0.2 + 0.4 * 0.75));
  // u runs over half the picture, from its middle.
  const std::string to_uv =
      "<transform name=\"to_uv\"><scale x=\"0.5\"/><translate x=\"0.5\"/></transform>";
  CHECK(at(-0.9f, -0.5f, nearest + to_uv) == doctest::Approx(0.3));
}

TEST_CASE("texture: checkerboards have two colours") {
  const std::string board =
      "<texture type=\"checkerboard\" name=\"reflectance\">"
      "<rgb name=\"color0\" value=\"0.9\"/><rgb name=\"color1\" value=\"0.1\"/>"
      "<transform name=\"to_uv\"><scale value=\"2\"/></transform></texture>";
  const std::string shape = "<shape type=\"rectangle\">" + textured(board) + "</shape>";
  CHECK(seen(shape, {0, 0, 3}, {-0.9f, -0.9f, 0}) == doctest::Approx(0.9));
  CHECK(seen(shape, {0, 0, 3}, {-0.4f, -0.9f, 0}) == doctest::Approx(0.1));
  CHECK(seen(shape, {0, 0, 3}, {-0.9f, 0.6f, 0}) == doctest::Approx(0.1));
  CHECK(seen(shape, {0, 0, 3}, {-0.4f, -0.4f, 0}) == doctest::Approx(0.9));
}

TEST_CASE("texture: texture coordinates of an obj count from the bottom unless they are flipped") {
  const Folder folder;
  const auto obj = folder.write("a.obj",
                                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 "
                                "1\nf 1/1 2/2 3/3 4/4\n");
  const std::string name = picture(folder, "a.exr", 2, 2, [](int x, int y) {
    return glm::vec3(0.1f + 0.2f * static_cast<float>(x) + 0.4f * static_cast<float>(y));
  });
  const auto at = [&](float x, float y, const std::string& more) {
    return seen("<shape type=\"obj\">" + file(obj) + more +
                    textured(bitmap("reflectance", name, text_value("filter_type", "nearest"))) +
                    "</shape>",
                {0.1f, 0.2f, 3}, {x, y, 0});
  };
  const std::string as_is = "<boolean name=\"flip_tex_coords\" value=\"false\"/>";
  CHECK(at(0.8f, 0.9f, "") == doctest::Approx(0.3));
  CHECK(at(0.1f, 0.2f, "") == doctest::Approx(0.5));
  CHECK(at(0.8f, 0.9f, as_is) == doctest::Approx(0.7));
  CHECK(at(0.1f, 0.2f, as_is) == doctest::Approx(0.1));
}

TEST_CASE("texture: texture coordinates of a ply are as they are unless they are flipped") {
  const Folder folder;
  const auto ply = folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\nproperty float u\nproperty float v\nelement face 1\nproperty list uchar int "
      "vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n");
  const auto v = [&](const std::string& more) {
    const auto scene =
        build(some_meter + "<shape type=\"ply\">" + file(ply) + more +
              textured("<texture type=\"checkerboard\" name=\"reflectance\"/>") + "</shape>");
    return hit_of(scene, {0.1f, 0.2f, 3}, {0.8f, 0.9f, 0}).uv.y;
  };
  CHECK(v("") == doctest::Approx(0.9));
  CHECK(v("<boolean name=\"flip_tex_coords\" value=\"true\"/>") == doctest::Approx(0.1));
}

TEST_CASE("texture: where one number is wanted of a colour it is its luminance") {
  // ITU-R BT.709.
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (std::size_t c = 0; c < 3; ++c) {
    CAPTURE(c);
    Rgb color(0.0f);
    color.set(c, 1.0f);
    const Texture pure(renderer::Bitmap({1, 1, {color}}, renderer::Bitmap::Filter::nearest,
                                        renderer::Bitmap::Wrap::repeat),
                       {});
    CHECK(renderer::FloatTexture(pure)({}) == doctest::Approx(weights[c]).epsilon(1e-3));
    CHECK(renderer::FloatTexture(pure).mean() == doctest::Approx(weights[c]).epsilon(1e-3));
  }
}

TEST_CASE("texture: u and v of a sphere, a cube and a mesh without them are Mitsuba's") {
  const std::string checkers = textured("<texture type=\"checkerboard\" name=\"reflectance\"/>");
  const auto sphere = build(some_meter + "<shape type=\"sphere\">" + checkers + "</shape>");
  const auto uv = [](const renderer::Scene& scene, const Vec3& from, const Vec3& to) {
    return hit_of(scene, from, to).uv;
  };
  const auto same = [](const Vec2& a, const Vec2& b) { CHECK(glm::length(a - b) < 1e-5f); };
  same(uv(sphere, {3, 3, 0}, {0, 0, 0}), {0.125f, 0.5f});
  same(uv(sphere, {0, -3, 0}, {0, 0, 0}), {0.75f, 0.5f});
  same(uv(sphere, {-3, -0.003f, 3}, {0, 0, 0}),
       {0.5f + std::atan(0.001f) / (2 * renderer::pi), 0.25f});
  const auto cube = build(some_meter + "<shape type=\"cube\">" + checkers + "</shape>");
  same(uv(cube, {3, 0.5f, 0.2f}, {1, 0.5f, 0.2f}), {0.75f, 0.4f});
  const Folder folder;
  const auto ply =
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                   "property float y\nproperty float z\nelement face 1\nproperty list "
                   "uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 4 0\n3 0 1 2\n");
  const auto bare = build(some_meter + "<shape type=\"ply\">" + file(ply) + checkers + "</shape>");
  same(uv(bare, {0.5f, 1, 3}, {0.5f, 1, 0}), {0.25f, 0.25f});
}

TEST_CASE("texture: the partial derivatives of a surface are those of its points by u and v") {
  const Folder folder;
  const std::string bump =
      "<bsdf type=\"bumpmap\">" +
      bitmap("height", picture(folder, "a.exr", 2, 2, [](int, int) { return glm::vec3(0); })) +
      bsdf("diffuse") + "</bsdf>";
  const auto obj = folder.write("a.obj",
                                "v 0 0 0\nv 1.5 0.1 0.2\nv 1.3 1 0.4\nvt 0.1 0.2\nvt 0.9 0.3\nvt "
                                "0.8 0.7\nf 1/1 2/2 3/3\n");
  const std::string turned =
      "<transform name=\"to_world\"><rotate x=\"1\" y=\"2\" z=\"-1\" angle=\"40\"/></transform>";
  struct Case {
    std::string shape;
    Vec3 at;
    float tolerance;
  };
  for (const Case& c :
       {Case{"<shape type=\"sphere\">" + turned + bump + "</shape>", {0.3f, 0.2f, 0.5f}, 0.02f},
        Case{"<shape type=\"obj\">" + file(obj) + bump + "</shape>", {0.9f, 0.4f, 0.2f}, 2e-3f}}) {
    const auto scene = build(some_meter + c.shape);
    const Vec3 from(2, 1.5f, 4);
    const Hit a = hit_of(scene, from, c.at);
    for (const Vec3 step : {Vec3(3e-3f, 0, 0), Vec3(0, 3e-3f, 0)}) {
      const Hit b = hit_of(scene, from, c.at + step);
      const Vec2 d = b.uv - a.uv;
      const Vec3 moved = b.position - a.position, expected = d.x * a.dp_du + d.y * a.dp_dv;
      CHECK(glm::length(moved - expected) < c.tolerance * glm::length(moved));
    }
  }
}

TEST_CASE("texture: a texture that is referred to twice is read once") {
  const Folder folder;
  const std::string name = picture(folder, "a.exr", 2, 2, [](int, int) { return glm::vec3(0.5f); });
  const std::string shared = bsdf("diffuse", "<ref id=\"t\" name=\"reflectance\"/>");
  const auto scene = build(some_meter + "<texture type=\"bitmap\" id=\"t\">" + file(name) +
                           "</texture><shape type=\"sphere\">" + shared +
                           "</shape><shape type=\"cube\">" + shared + "</shape>");
  CHECK(scene.textures.size() == 1);
  CHECK(scene.shapes[0].material.needs.uv);
}

TEST_CASE("texture: what is wrong with a texture or its file is said with names and lines") {
  const Folder folder;
  const auto error = [&](const std::string& parameter) {
    return scene_test::error_of(
        [&] { build(some_meter + "<shape type=\"sphere\">" + textured(parameter) + "</shape>"); });
  };
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", "none.png")), "scene.xml:3: ", "none.png",
                    "no such file");
  const std::string broken = folder.write("broken.png", "\x89PNG\r\n\x1a\nand no more");
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", broken)), "scene.xml:3: ", "broken.png",
                    "begins as a PNG", "truncated or damaged");
  const std::string words = folder.write("words.png", "this is no picture");
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", words)), "words.png", "cannot be read");
  const std::string cut = folder.write("cut.exr", "\x76\x2f\x31\x01 cut");
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", cut)), "cut.exr", "OpenEXR");
  const auto hdr = [&](const std::string& content) {
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    return error(bitmap("reflectance", folder.write("bad.hdr", head + content)));
  };
  CHECK_MESSAGE_HAS(hdr("-Y 65535 +X 65535\n"), "bad.hdr", "ends too early");
  CHECK_MESSAGE_HAS(hdr("-Y 70000 +X 1\n"), "70000", "up to 65536");
  CHECK_MESSAGE_HAS(hdr(std::string("-Y 1 +X 8\n\x02\x02\0\x08\x89\1\2\3\4", 20)), "a run");
  CHECK_MESSAGE_HAS(hdr(std::string("-Y 1 +X 8\n\x02\x02\0\x08\0\0\0\0", 18)), "a run");
  // A header alone that claims 65535 x 65535 pixels.
  const std::string huge =
      folder.write("huge.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\0", 18));
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", huge)), "huge.tga", "damaged", "65535");
  const std::string codes = folder.write(
      "codes.jpg", std::string("\xff\xd8\xff\xc4\0\x13\0", 7) + std::string(16, '\xff'));
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", codes)), "codes.jpg", "more than 256 codes");
  renderer::write_exr(folder.path() / "depth.exr", renderer::Image(1, 1, {"Z"}));
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", folder.path() / "depth.exr")), "depth.exr",
                    "the channels Z; needed: R, G and B, or Y");
  const std::string bright = picture(folder, "bright.exr", 2, 2, [](int x, int) {
    return glm::vec3(0.2f, x == 0 ? 0.5f : 1.5f, 0);
  });
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", bright)), "scene.xml:3: ", "reflectance",
                    "1.5; allowed: 0 to 1");
  const std::string nan = picture(folder, "nan.exr", 3, 2, [](int x, int y) {
    return glm::vec3(x == 2 && y == 1 ? std::nanf("") : 0.5f);
  });
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", nan)), "nan.exr", "column 2, row 1");
  const std::string good = picture(folder, "a.exr", 2, 2, [](int, int) { return glm::vec3(0.5f); });
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", good, text_value("wrap_mode", "tile"))),
                    "wrap_mode", "allowed: repeat, mirror, clamp");
  CHECK_MESSAGE_HAS(error(bitmap("reflectance", good, number("gamma", 2))), "unknown parameter",
                    "gamma", "filename", "filter_type", "to_uv", "raw");
  CHECK_MESSAGE_HAS(error("<texture type=\"noise\" name=\"reflectance\"/>"), "noise",
                    "known are bitmap, checkerboard");
  CHECK_MESSAGE_HAS(error(bitmap("roughness", good)), "diffuse", "roughness",
                    "allowed: reflectance");
}
