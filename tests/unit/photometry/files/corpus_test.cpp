// A corpus of photometric files whose flux is known in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "photometry/files/photometric_file.hpp"
#include "unit/photometry/files/photometric_texts.hpp"

namespace enfilade {
namespace {

using testing::IesParts;
using testing::LdtParts;
using testing::radians;
using testing::steps;

struct Case {
  std::string name;  ///< with the ending
  std::string text;
  double flux_lm;
  std::string warning;  ///< a part of it; empty where there must be none
};

std::string changed(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string utf16(const std::string& text, bool mark) {
  std::string wide = mark ? "\xFF\xFE" : "";
  for (const char c : text) wide += std::string(1, c) + '\0';
  return wide;
}

using std::numbers::pi;

/// cos(gamma) (1 + 0.5 shape(C)) below, peak 1; the flux is pi where the shape has no mean.
testing::Intensity leaning(double (*shape)(double)) {
  return [shape](double c, double gamma) {
    return gamma >= 90.0 ? 0.0 : std::cos(radians(gamma)) * (1.0 + 0.5 * shape(radians(c)));
  };
}
double toward_0(double c) { return std::cos(c); }
double toward_90(double c) { return std::sin(c); }
double quarters(double c) { return std::cos(2.0 * c); }
double askew(double c) { return 0.6 * std::cos(c) + 0.7 * std::sin(c); }

/// cos^n of the angle from the aim, by horizontal and vertical angle of types A and B.
testing::Intensity floodlight(double n) {
  return [n](double h, double v) {
    return std::pow(std::max(0.0, std::cos(radians(h)) * std::cos(radians(v))), n);
  };
}

void add_symmetries(std::vector<Case>& cases) {
  for (const double n : {0.0, 1.0, 2.0, 8.0, 60.0}) {
    IesParts p;
    p.intensity = testing::cosine_power(n);
    if (n == 0.0) p.intensity = [](double, double gamma) { return gamma > 90.0 ? 0.0 : 1.0; };
    if (n == 60.0) p.vertical = steps(0, 90, 0.5);
    cases.push_back({"rotational_" + std::to_string(static_cast<int>(n)) + ".ies", p.text(),
                     1000.0 * testing::flux_of_cosine_power(n), ""});
  }
  const struct {
    const char* name;
    double last;
    double (*shape)(double);
    double first = 0.0;
  } planes[]{{"quadrant", 90, quarters},
             {"bilateral", 180, toward_0},
             {"whole", 360, askew},
             {"bilateral_90", 270, toward_90, 90.0},
             {"leaning_back", 360, toward_90}};
  for (const auto& kind : planes) {
    IesParts p;
    p.horizontal = steps(kind.first, kind.last, 5);
    p.intensity = leaning(kind.shape);
    cases.push_back({std::string(kind.name) + ".ies", p.text(), 1000.0 * pi, ""});
  }
  IesParts up;
  up.vertical = steps(90, 180, 1);
  up.intensity = [](double, double gamma) { return std::cos(radians(180.0 - gamma)); };
  cases.push_back({"upward.ies", up.text(), 1000.0 * pi, ""});
  IesParts ball;
  ball.vertical = steps(0, 180, 5);
  ball.intensity = [](double, double) { return 1.0; };
  cases.push_back({"all_around.ies", ball.text(), 4000.0 * pi, ""});
  IesParts uneven;
  uneven.vertical = {0,  1,  2,  3,  5,  7,  9,  12, 15, 18, 21, 25, 29, 33, 37, 41,
                     45, 49, 53, 57, 61, 65, 69, 73, 76, 79, 82, 84, 86, 88, 90};
  cases.push_back({"uneven_angles.ies", uneven.text(), 1000.0 * pi, ""});
  IesParts street;
  street.horizontal = steps(0, 345, 15);
  street.intensity = leaning(askew);
  cases.push_back({"circle_not_closed.ies", street.text(), 1000.0 * pi, ""});
}

void add_types(std::vector<Case>& cases) {
  for (const double n : {1.0, 20.0}) {
    for (const double first : {-90.0, 0.0}) {
      for (const int type : {2, 3}) {
        IesParts p;
        p.type = type;
        p.vertical = steps(-90, 90, n > 1.0 ? 1 : 2);
        p.horizontal = steps(first, 90, n > 1.0 ? 1 : 2);
        p.intensity = floodlight(n);
        cases.push_back({fmt::format("type_{}_{:g}_{:g}.ies", type == 2 ? "b" : "a", n, -first),
                         p.text(), 1000.0 * testing::flux_of_cosine_power(n), ""});
      }
    }
  }
}

void add_factors(std::vector<Case>& cases) {
  IesParts p;
  p.multiplier = 2.5;
  cases.push_back({"multiplier.ies", p.text(), 2500.0 * pi, ""});
  p.ballast = 0.88;
  cases.push_back({"ballast.ies", p.text(), 2200.0 * pi, ""});
  p.third = 0.9;
  cases.push_back({"third_factor_2002.ies", p.text(), 2200.0 * pi, ""});
  p.version = "IES:LM-63-2019";
  p.third = 1.11010;
  cases.push_back({"generation_2019.ies", p.text(), 2200.0 * pi, ""});
  p.version = "IESNA:LM-63-1995";
  p.third = 0.9;
  cases.push_back({"third_factor_1995.ies", p.text(), 1980.0 * pi, ""});
  p.version = "IESNA91";
  cases.push_back({"third_factor_1991.ies", p.text(), 1980.0 * pi, ""});
  p.version = "";
  p.keywords = "A luminaire of 1986\r\nwith words alone\r\n";
  cases.push_back({"no_version_1986.ies", p.text(), 1980.0 * pi, ""});
  IesParts lamps;
  lamps.lamps = 3;
  lamps.lumens = 1200;
  cases.push_back({"three_lamps.ies", lamps.text(), 1000.0 * pi, ""});
  IesParts tilted;
  tilted.tilt = "TILT=INCLUDE\r\n1\r\n4\r\n0 30 60 90\r\n1 0.95 0.9 0.85\r\n";
  cases.push_back({"tilt_included.ies", tilted.text(), 1000.0 * pi, ""});
}

void add_eulumdat(std::vector<Case>& cases) {
  const double flux = 0.5 * pi * 1000.0;  // 200 cd/klm of 2,500 lm
  LdtParts p;
  p.light_output = 100.0 * 0.2 * pi;
  cases.push_back({"point.ldt", p.text(), flux, ""});
  const struct {
    int symmetry;
    double (*shape)(double);
  } kinds[]{{0, askew}, {2, toward_0}, {3, toward_90}, {4, quarters}};
  for (const auto& kind : kinds) {
    LdtParts q = p;
    q.symmetry = kind.symmetry;
    q.planes = steps(0, 355, 5);
    q.intensity = leaning(kind.shape);
    cases.push_back({fmt::format("symmetry_{}.ldt", kind.symmetry), q.text(), flux, ""});
  }
  LdtParts absolute = p;
  absolute.lamps = -1;
  cases.push_back({"absolute.ldt", absolute.text(), flux, ""});
  LdtParts factor = p;
  factor.factor = 2.0;
  cases.push_back({"factor.ldt", factor.text(), flux, ""});
  LdtParts sets = p;
  sets.sets = "2";
  sets.more_lamps = "2\r\nT16\r\n5000\r\n3000\r\n80\r\n60\r\n";
  cases.push_back({"two_sets.ldt", sets.text(), flux, "the first is taken"});
  LdtParts candela = p;
  candela.peak_per_klm = 500.0;
  cases.push_back({"candela.ldt", candela.text(), flux, "not per 1000 lm"});
  LdtParts ratio = p;
  ratio.light_output = 80.0;
  cases.push_back({"wrong_ratio.ldt", ratio.text(), flux, "light output ratio"});
  cases.push_back({"decimal_commas.ldt", changed(p.text(), ".", ","), flux, "decimal commas"});
}

/// The same light in every odd form.
void add_forms(std::vector<Case>& cases) {
  IesParts p;
  p.horizontal = {0, 45, 90};
  const std::string text = p.text();
  const double flux = 1000.0 * pi;
  cases.push_back({"lf.ies", changed(text, "\r\n", "\n"), flux, ""});
  cases.push_back({"cr.ies", changed(text, "\r\n", "\r"), flux, ""});
  cases.push_back({"bom.ies", "\xEF\xBB\xBF" + text, flux, "byte order mark"});
  cases.push_back({"utf16.ies", utf16(text, true), flux, "UTF-16"});
  cases.push_back({"utf16_without_mark.ies", utf16(text, false), flux, "UTF-16"});
  cases.push_back({"latin1.ies", changed(text, "Own", "L\xE4mpen"), flux, ""});
  cases.push_back({"control_z.ies", text + "\x1A\x1A", flux, ""});
  cases.push_back({"tabs.ies", changed(text, " ", "\t"), flux, ""});
  cases.push_back({"commas_between.ies", changed(changed(text, "TILT=NONE", "#"), " ", ","), flux,
                   "no TILT line"});
  cases.push_back({"as_ldt.ldt", text, flux, "is an IES file"});
  cases.push_back({"spaces.ies", changed(text, "TILT=NONE", "  TILT = NONE  "), flux, ""});
}

std::vector<Case> corpus() {
  std::vector<Case> cases;
  add_symmetries(cases);
  add_types(cases);
  add_factors(cases);
  add_eulumdat(cases);
  add_forms(cases);
  return cases;
}

class Corpus : public ::testing::TestWithParam<Case> {};

TEST_P(Corpus, HasTheFluxOfTheClosedForm) {
  const Case& c = GetParam();
  Warnings warnings;
  const PhotometricFile file = read_photometric_file(c.text, c.name, warnings);
  EXPECT_NEAR(file.distribution->flux(), c.flux_lm, 1e-3 * c.flux_lm);
  if (c.warning.empty()) {
    for (const Warning& w : warnings.all()) ADD_FAILURE() << w.what;
  } else {
    ASSERT_EQ(warnings.all().size(), 1u);
    EXPECT_THAT(warnings.all()[0].what, ::testing::HasSubstr(c.warning));
  }
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return changed(changed(info.param.name, ".", "_"), "-", "_");
}

INSTANTIATE_TEST_SUITE_P(Files, Corpus, ::testing::ValuesIn(corpus()), name_of);

TEST(PhotometricCorpus, HasFortyFiles) { EXPECT_GE(corpus().size(), 40u); }

}  // namespace
}  // namespace enfilade
