// Curves of a region in words.
#include "stability/region_rows.hpp"

namespace surefoot::stability {
namespace {

std::string row_in_words(const RegionRow& row) {
  const std::string foot = std::to_string(row.contact + 1);
  switch (row.meaning) {
    case RowMeaning::lifts: return "contact " + foot + " lifts off";
    case RowMeaning::turns: return "turning about contact " + foot + " reverses";
    case RowMeaning::cone_u: return "force at " + foot + " on cone edge u";
    case RowMeaning::cone_w: return "force at " + foot + " on cone edge w";
    case RowMeaning::slides: return "sliding at " + foot + " reverses";
    case RowMeaning::pushes: return "force at " + foot + " vanishes";
    case RowMeaning::moves: return "the motion reverses";
  }
  return {};
}

std::string coordinate(const char* name, const char* half_side, double centre, int end) {
  std::string text = std::string(name) + " = ";
  if (centre != 0) text += std::string(name) + "0 ";
  return text + (end > 0 ? "+" : "-") + half_side;
}

}  // namespace

std::string curve_in_words(const RegionMode& mode, const CurveId& id, const WrenchBox& box) {
  std::string text = mode.mode.name() + ": ";
  if (id.kind == CurveId::denominator) return text + "D = 0";
  for (int k = 0; k < 3 && id.row(k) >= 0; ++k) text += (k == 0 ? "" : " and ") + row_in_words(mode.row[id.row(k)]);
  const bool at_u = id.kind == CurveId::corner || (id.kind == CurveId::side && id.place < 2);
  const bool at_w = id.kind == CurveId::corner || (id.kind == CurveId::side && id.place >= 2);
  const int end_w = id.kind == CurveId::corner ? (id.place & 2) : (id.place & 1);
  if (at_u && box.kappa > 0) text += ", " + coordinate("p", "kappa", box.centre.p, (id.place & 1) ? 1 : -1);
  if (at_w && box.nu > 0) text += ", " + coordinate("q", "nu", box.centre.q, end_w ? 1 : -1);
  return text;
}

}  // namespace surefoot::stability
