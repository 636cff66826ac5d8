// What others write by mistake: read with a warning where it is clear, else refused in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "photometry/files/photometric_file.hpp"
#include "unit/photometry/files/photometric_texts.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using testing::IesParts;
using testing::LdtParts;
using testing::steps;

using std::numbers::pi;

/// The one warning of a file whose flux must be `flux`.
std::string warning_of(const std::string& text, const char* name, double flux) {
  Warnings warnings;
  const PhotometricFile file = read_photometric_file(text, name, warnings);
  EXPECT_NEAR(file.distribution->flux(), flux, 1e-3 * flux);
  EXPECT_EQ(warnings.all().size(), 1u);
  return warnings.empty() ? "" : warnings.all()[0].what;
}

std::string refusal_of(const std::string& text, const char* name) {
  Warnings warnings;
  try {
    const PhotometricFile file = read_photometric_file(text, name, warnings);
    ADD_FAILURE() << "read with " << file.distribution->flux() << " lm";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(FaultyIes, IsReadWithAWarning) {
  IesParts p;
  const double flux = 1000.0 * pi;
  EXPECT_THAT(warning_of(p.text() + "written by hand\r\n", "a.ies", flux),
              HasSubstr("text behind"));
  EXPECT_THAT(warning_of(p.text() + "1 2 3\r\n", "a.ies", flux), HasSubstr("3 numbers more"));
  EXPECT_THAT(warning_of(replaced(p.text(), "TILT=NONE\r\n", ""), "a.ies", flux),
              HasSubstr("no TILT"));
  EXPECT_THAT(warning_of(replaced(p.text(), "TILT=NONE", "TILT=lamp.tlt"), "a.ies", flux),
              HasSubstr("lamp.tlt"));
  EXPECT_THAT(warning_of(replaced(p.text(), " 91 1 1 2 ", " 37 5 1 2 "), "a.ies", flux),
              HasSubstr("holds 91 and 1"));
  IesParts zero;
  zero.multiplier = 0;
  EXPECT_THAT(warning_of(zero.text(), "a.ies", flux), HasSubstr("multiplier of 0"));
  IesParts millimetres;
  millimetres.width = millimetres.length = 600;
  EXPECT_THAT(warning_of(millimetres.text(), "a.ies", flux), HasSubstr("millimetres"));
  IesParts odd_size;
  odd_size.width = 0.5;
  odd_size.length = -0.5;
  odd_size.height = 0.2;
  EXPECT_THAT(warning_of(odd_size.text(), "a.ies", flux), HasSubstr("does not know"));
  IesParts type;
  type.type = 0;
  EXPECT_THAT(warning_of(type.text(), "a.ies", flux), HasSubstr("type of photometry"));
  IesParts lamps;
  lamps.lumens = 1000;
  EXPECT_THAT(warning_of(lamps.text(), "a.ies", flux), HasSubstr("multiplier or lumens"));
  IesParts twice;
  twice.horizontal = {0, 90, 90};
  EXPECT_THAT(warning_of(twice.text(), "a.ies", flux), HasSubstr("twice"));
  IesParts turned;
  turned.horizontal = {90, 45, 0};
  EXPECT_THAT(warning_of(turned.text(), "a.ies", flux), HasSubstr("put in order"));
  IesParts below;
  below.horizontal = {-180, -90, 0, 90, 180};
  Warnings warnings;
  EXPECT_NEAR(read_photometric_file(below.text(), "a.ies", warnings).distribution->flux(), flux,
              1e-3 * flux);
}

TEST(FaultyIes, HasItsDecimalCommasRead) {
  IesParts p;
  p.multiplier = 1.5;
  p.vertical = steps(0.5, 90, 0.5);
  std::string text = p.text();
  for (std::size_t i = text.find("TILT"); i < text.size(); ++i)
    if (text[i] == '.') text[i] = ',';
  Warnings warnings;
  const PhotometricFile file = read_photometric_file(text, "a.ies", warnings);
  EXPECT_NEAR(file.distribution->flux(), 1500.0 * pi, 1.5 * pi);
  ASSERT_EQ(warnings.all().size(), 1u);
  EXPECT_THAT(warnings.all()[0].what, HasSubstr("decimal commas"));
}

TEST(FaultyIes, IsRefusedInOneLineWhereItIsNotClear) {
  IesParts p;
  p.horizontal = {0, 45, 90};
  const std::string text = p.text();
  EXPECT_THAT(refusal_of(text.substr(0, text.size() - 40), "a.ies"), HasSubstr("holds"));
  EXPECT_THAT(refusal_of(replaced(text, "\r\n0 45 90", "\r\n0 fortyfive 90"), "a.ies"),
              HasSubstr("fortyfive"));
  EXPECT_THAT(refusal_of("", "a.ies"), HasSubstr("get the file again"));
  EXPECT_THAT(refusal_of("%PDF-1.4 no luminaire", "a.ies"), HasSubstr("no LM-63 file"));
  IesParts planes;
  planes.horizontal = {0, 35, 70};
  EXPECT_THAT(refusal_of(planes.text(), "a.ies"), HasSubstr("no part of a symmetry"));
  IesParts negative;
  negative.multiplier = -1;
  EXPECT_THAT(refusal_of(negative.text(), "a.ies"), HasSubstr("multiplier of -1"));
  IesParts dark;
  dark.intensity = [](double, double) { return 0.0; };
  EXPECT_THAT(refusal_of(dark.text(), "a.ies"), HasSubstr("no light"));
  IesParts below;
  below.intensity = [](double, double) { return -1.0; };
  EXPECT_THAT(refusal_of(below.text(), "a.ies"), HasSubstr("below zero"));
  IesParts angles;
  angles.vertical = steps(-90, 90, 5);
  EXPECT_THAT(refusal_of(angles.text(), "a.ies"), HasSubstr("type C"));
  EXPECT_THAT(refusal_of(replaced(text, "1000", "nan"), "a.ies"), HasSubstr("nan"));
}

TEST(FaultyEulumdat, IsReadWithAWarningOrRefused) {
  LdtParts p;
  const double flux = 500.0 * pi;
  p.length = -600;
  EXPECT_THAT(warning_of(p.text(), "a.ldt", flux), HasSubstr("below zero"));
  p.length = 600;
  EXPECT_THAT(warning_of(p.text() + "the end\r\n", "a.ldt", flux), HasSubstr("text behind"));
  LdtParts all_planes;
  all_planes.symmetry = 0;
  all_planes.planes = steps(0, 270, 90);
  std::string stated = all_planes.text();
  stated[stated.find("\r\n0\r\n4\r\n") + 2] = '4';  // says quadrants, lists all planes
  EXPECT_THAT(warning_of(stated, "a.ldt", flux), HasSubstr("otherwise than its symmetry"));
  EXPECT_THAT(refusal_of(p.text().substr(0, p.text().size() - 60), "a.ldt"), HasSubstr("holds"));
  p.flux = 0;
  EXPECT_THAT(refusal_of(p.text(), "a.ldt"), HasSubstr("lamps without flux"));
  p.flux = 2500;
  p.symmetry = 7;
  EXPECT_THAT(refusal_of(p.text(), "a.ldt"), HasSubstr("the symmetry is wanted"));
  EXPECT_THAT(refusal_of("one\ntwo\n", "a.ldt"), HasSubstr("no EULUMDAT"));
}

TEST(FaultyOpenings, AreRefused) {
  for (const double millimetres : {1e-300, 1e-4, 1e9, 1e300}) {
    LdtParts p;
    p.width = millimetres;
    EXPECT_THAT(refusal_of(p.text(), "a.ldt"), HasSubstr("has a length out of range")) << p.width;
  }
  IesParts p;
  p.width = p.length = 1e-300;
  EXPECT_THAT(refusal_of(p.text(), "a.ies"), HasSubstr("has a length out of range"));
}

TEST(IesTilt, IsReadFromTheFileBesideIt) {
  IesParts p;
  p.tilt = "TILT=lamp.tlt\r\n";
  Warnings warnings;
  const PhotometricFile file =
      read_photometric_file(p.text(), "a.ies", warnings, [](const std::string& name) {
        EXPECT_EQ(name, "lamp.tlt");
        return std::optional<std::string>("1\n3\n0 45 90\n1 0.9 0.7\n");
      });
  EXPECT_TRUE(warnings.empty());
  EXPECT_DOUBLE_EQ(file.tilt.factor(45.0), 0.9);
  EXPECT_NEAR(file.tilt.factor(67.5), 0.8, 1e-12);
  EXPECT_DOUBLE_EQ(file.tilt.factor(120.0), 0.7);
}

}  // namespace
}  // namespace enfilade
