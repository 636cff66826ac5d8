#include "view_factors/view_factor_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

#include "base/safe_text.hpp"

namespace enfilade {
namespace {

/// Names without the characters of `banned`, each another.
std::vector<std::string> plain_names(const std::vector<std::string>& names, std::string_view banned,
                                     char instead) {
  std::vector<std::string> plain;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    std::string text = on_one_line(file_text(name));
    for (char& c : text) {
      if (banned.find(c) != std::string_view::npos) c = instead;
    }
    std::string unique = text;
    for (int i = 2; !taken.insert(unique).second; ++i) unique = fmt::format("{}_{}", text, i);
    plain.push_back(std::move(unique));
  }
  return plain;
}

/// What was done to the rows, as comment lines.
std::string account(const ViewFactors& f, std::string_view mark) {
  std::string text;
  const auto out = std::back_inserter(text);
  const auto closed = std::count(f.closed.begin(), f.closed.end(), true);
  fmt::format_to(out, "{} View factors by Enfilade, with visibility; A_i F_ij = A_j F_ji.\n", mark);
  fmt::format_to(out,
                 "{} {} of {} rows end on front sides everywhere, and were closed: scaled "
                 "symmetrically to sum to 1.\n",
                 mark, closed, f.size());
  fmt::format_to(out, "{} Reciprocity and closure changed a factor by at most {:.2g}.\n", mark,
                 f.largest_closure);
  fmt::format_to(out, "{} Sums of the rows before:", mark);
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (i % 10 == 0) fmt::format_to(out, "\n{}  ", mark);
    fmt::format_to(out, " {:.6f}", f.sum_before[i]);
  }
  return text + "\n";
}

}  // namespace

std::string view_factors_csv(const ViewFactors& f) {
  std::string csv = "from,to,view_factor,error,area_from_m2,area_to_m2,row_sum_before,closed\n";
  std::vector<std::string> fields;
  for (const std::string& name : f.names) fields.push_back(csv_field(name));
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < f.size(); ++j) {
      fmt::format_to(std::back_inserter(csv), "{},{},{:.9g},{:.2g},{:.9g},{:.9g},{:.7f},{}\n",
                     fields[i], fields[j], f.factor[i * f.size() + j], f.error[i * f.size() + j],
                     f.area_m2[i], f.area_m2[j], f.sum_before[i], f.closed[i] ? "yes" : "no");
    }
  }
  return csv;
}

std::string view_factors_idf(const ViewFactors& f, const std::string& zone) {
  const std::vector<std::string> names = plain_names(f.names, ",;!", ' ');
  std::string idf = account(f, "!") + "\nZoneProperty:UserViewFactors:BySurfaceName,\n  " +
                    plain_names({zone}, ",;!", ' ')[0];
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < f.size(); ++j) {
      fmt::format_to(std::back_inserter(idf), ",\n  {},{},{:.9f}", names[i], names[j],
                     f.factor[i * f.size() + j]);
    }
  }
  return idf + ";\n";
}

std::string view_factors_moose(const ViewFactors& f) {
  const std::vector<std::string> names = plain_names(f.names, " \t'\";#[]=", '_');
  std::string text = account(f, "#") +
                     "# Add to this object: temperature, and one emissivity for each boundary.\n"
                     "[UserObjects]\n  [view_factor_radiation]\n"
                     "    type = ConstantViewFactorSurfaceRadiation\n    boundary = '";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? " " : "") + names[i];
  text += "'\n    view_factors = '";
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (i > 0) text += ";\n                    ";
    for (std::size_t j = 0; j < f.size(); ++j)
      fmt::format_to(std::back_inserter(text), "{}{:.9g}", j > 0 ? " " : "",
                     f.factor[i * f.size() + j]);
  }
  return text + "'\n  []\n[]\n";
}

}  // namespace enfilade
