#include <fmt/format.h>

#include <iterator>

#include "report/drawing/charts.hpp"
#include "report/room_table/isolines.hpp"
#include "report/room_table/room_drawing.hpp"
#include "report/room_table/room_table.hpp"

namespace enfilade {
namespace {

/// Sorts a table by the column whose head is clicked, or chosen by the Enter key: numbers by their
/// data-value, empty cells last.
constexpr const char* sorting = R"js(<script>
document.querySelectorAll("table.sortable").forEach(table=>{
  const heads=[...table.tHead.rows[0].cells],body=table.tBodies[0];
  const key=(row,i)=>{const c=row.cells[i];return "value" in c.dataset?parseFloat(c.dataset.value):c.textContent};
  const empty=k=>k===""||Number.isNaN(k);
  heads.forEach((head,i)=>{
    const sort=()=>{
      const up=head.getAttribute("aria-sort")!=="ascending";
      heads.forEach(h=>h.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort",up?"ascending":"descending");
      [...body.rows].sort((a,b)=>{
        const x=key(a,i),y=key(b,i);
        if(empty(x)||empty(y))return empty(x)-empty(y);
        const order=typeof x==="number"&&typeof y==="number"?x-y:String(x).localeCompare(String(y),undefined,{numeric:true});
        return up?order:-order;
      }).forEach(row=>body.append(row));
    };
    head.tabIndex=0;
    head.addEventListener("click",sort);
    head.addEventListener("keydown",e=>{if(e.key==="Enter")sort()});
  });
});
</script>)js";

std::string head(const std::string& name, const std::string& unit, bool number = true) {
  return fmt::format(R"(<th scope="col"{}>{}{}</th>)", number ? " class=\"n\"" : "", name,
                     unit.empty() ? "" : "<br><small>" + escaped(unit) + "</small>");
}

std::string cell(double value, const std::string& shown) {
  return fmt::format(R"(<td class="n" data-value="{:.9g}">{}</td>)", value, shown);
}
std::string cell(const std::optional<Estimate>& estimate, bool with_error = true) {
  if (!estimate) return R"(<td class="n" data-value="">&ndash;</td>)";
  std::string shown = fmt::format("{:.4g}", estimate->value);
  if (with_error) shown += fmt::format(" <small>&plusmn;&#8239;{:.2g}</small>", estimate->error);
  return cell(estimate->value, shown);
}
std::string words(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }

std::string anchor(const std::string& id, std::size_t i) {
  return escaped(id) + "-" + std::to_string(i + 1);
}

std::string verdict_cell(const RoomFigures& room) {
  const Verdict verdict = verdict_of(room);
  const char* kind = verdict == Verdict::met ? "good" : verdict == Verdict::not_met ? "bad" : "";
  return fmt::format(R"(<td class="{}">{}</td>)", kind, name_of(verdict));
}

std::string row_of(const RoomTable& table, const RoomFigures& f, const std::string& anchor) {
  std::string name = escaped(f.room.name);
  if (!f.room.long_name.empty()) name += " <small>" + escaped(f.room.long_name) + "</small>";
  std::string html = fmt::format(R"(<tr><td><a href="#{}">{}</a></td>)", anchor, name);
  html += words(f.room.storey);
  html += cell(f.room.area_m2, fmt::format("{:.1f}", f.room.area_m2));
  html += cell(f.room.height_m(), fmt::format("{:.2f}", f.room.height_m()));
  html += cell(static_cast<double>(f.values.size()), std::to_string(f.values.size()));
  for (const auto* figure : {&f.mean, &f.minimum, &f.maximum}) html += cell(*figure);
  html += cell(f.u0);
  for (const auto* figure : {&f.walls, &f.ceiling, &f.cylindrical}) html += cell(*figure);
  for (const auto* figure : {&f.mean, &f.minimum, &f.median})
    if (table.outside > 0.0) html += cell(daylight_factor(table, *figure));
  html += f.room.required > 0.0 ? cell(f.room.required, fmt::format("{:.4g}", f.room.required))
                                : cell(std::nullopt);
  return html + verdict_cell(f) + "</tr>\n";
}

std::string room_rows(const RoomTable& table, const std::string& id) {
  std::string html = "<div class=\"scroll\"><table class=\"sortable rooms\"><thead><tr>";
  html += head("Room", "", false) + head("Storey", "", false) + head("Area", "m\u00b2") +
          head("Height", "m") + head("Points", "");
  for (const char* name : {"Mean", "Minimum", "Maximum"}) html += head(name, table.unit);
  html += head("U<sub>0</sub>", "");
  for (const char* name : {"Walls", "Ceiling", "Cylindrical"}) html += head(name, table.unit);
  for (const char* name : {"D mean", "D minimum", "D median"})
    if (table.outside > 0.0) html += head(name, "%");
  html += head("Required", table.unit);
  html += head("Verdict", "", false) + "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < table.rooms.size(); ++i)
    html += row_of(table, table.rooms[i], anchor(id, i));
  return html + "</tbody></table></div>";
}

std::string notes(const RoomTable& table) {
  std::string text = fmt::format(
      "Illuminance in {} on the grid of EN 12464-1, {:g} m above the floor; a band along the walls "
      "(0.5 m, or 15% of the shorter side) does not count. Mean of walls and ceiling; mean "
      "cylindrical illuminance at {:g} m. Maintenance factor {:g}{}. &plusmn; is one standard "
      "deviation; a verdict is given beyond two.",
      escaped(table.unit), table.plane_m, table.cylindrical_m, table.maintenance_factor,
      table.maintenance_factor == 1.0 ? " (new installation)" : "");
  if (table.outside > 0.0) {
    text += fmt::format(
        " D is the daylight factor: illuminance in the working plane over that of an unobstructed "
        "horizontal plane outside, {:.5g} {}.",
        table.outside, escaped(table.unit));
  } else if (!table.no_daylight_factor.empty()) {
    text += " No daylight factors: " + escaped(table.no_daylight_factor) + ".";
  }
  if (!table.weights.empty()) text += " Bands as one value: " + escaped(table.weights) + ".";
  return "<p class=\"soft\">" + text + "</p>";
}

std::string glare_rows(const RoomTable& table) {
  if (table.glare.empty()) return "";
  std::string html = "<h3>Glare</h3><div class=\"scroll\"><table class=\"sortable\"><thead><tr>" +
                     head("Place", "", false) + head("Room", "", false) + head("UGR", "") +
                     head("Background", "cd/m\u00b2") + head("Sources seen", "") +
                     "</tr></thead><tbody>\n";
  for (const GlareRating& rating : table.glare) {
    html += "<tr>" + words(rating.place.name) + words(room_at(table.rooms, rating.place.p)) +
            cell(rating.ugr) +
            cell(rating.background_cd_m2, fmt::format("{:.4g}", rating.background_cd_m2)) +
            cell(static_cast<double>(rating.sources), std::to_string(rating.sources)) + "</tr>\n";
  }
  return html + "</tbody></table></div>";
}

std::string legend(const LightScale& scale, const std::string& unit) {
  std::string html = "<div class=\"legend\"><span>" + escaped(unit) + "</span>";
  for (const double level : scale_levels(scale.lowest, scale.highest, 12)) {
    fmt::format_to(std::back_inserter(html), R"(<span><i style="background:{}"></i>{:g}</span>)",
                   css(scale.colour(level)), level);
  }
  return html + "</div>";
}

std::string left_out(const RoomFigures& f) {
  std::string text;
  if (f.in_furniture > 0) text += fmt::format("; {} in furniture left out", f.in_furniture);
  if (f.without_floor > 0)
    text += fmt::format("; {} without a floor below left out", f.without_floor);
  return text;
}

std::string plans(const RoomTable& table, const std::string& id) {
  const LightScale scale = scale_of(table.rooms);
  std::string html = legend(scale, table.unit) + "<div class=\"grid2 rooms\">";
  for (std::size_t i = 0; i < table.rooms.size(); ++i) {
    const RoomFigures& f = table.rooms[i];
    fmt::format_to(std::back_inserter(html), R"(<figure class="card" id="{}">{}<figcaption>)",
                   anchor(id, i), to_inline_svg(room_drawing(f, scale, table.unit)));
    html += "<b>" + escaped(f.room.name) + "</b> " + escaped(f.room.long_name) + "<br>";
    if (f.mean) {
      fmt::format_to(std::back_inserter(html),
                     "mean {:.4g} {}, minimum {:.4g}, U<sub>0</sub> {:.2f}; ", f.mean->value,
                     escaped(table.unit), f.minimum->value, f.u0 ? f.u0->value : 0.0);
    }
    fmt::format_to(std::back_inserter(html), "{} points, {:.2f} m apart{}</figcaption></figure>\n",
                   f.values.size(), f.grid.spacing_m, left_out(f));
  }
  return html + "</div>";
}

}  // namespace

std::string rooms_html(const RoomTable& table, const std::string& id) {
  if (table.rooms.empty()) return "";
  return "<h3>Rooms</h3>" + room_rows(table, id) + notes(table) + glare_rows(table) +
         "<h3>Light in the working plane</h3>" + plans(table, id) + sorting;
}

}  // namespace enfilade
