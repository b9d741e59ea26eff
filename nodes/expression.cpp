// An expression: one number computed from up to four by a formula, with its units checked.
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "core/base/mathematics.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {
namespace {

constexpr std::array kInputs = {"a", "b", "c", "d"};
constexpr std::array kBases = {&Dimension::length, &Dimension::time, &Dimension::angle, &Dimension::money};
constexpr std::array kBaseNames = {"m", "s", "deg", "EUR"};
// Rescaling by 64 is exact in binary, also under square and cube roots, so that a sound formula rescales without rounding.
constexpr int kScaleBits = 6, kSamples = 24, kLargestPower = 9, kLongestFormula = 500;

// Replaces `^` while the parser reads: the parser's own `^` cannot be replaced, and calls the C library. No formula can contain
// it.
constexpr char kPowerSign = '\x7f';

// The functions of formulas, which give the same bits on every processor. The parser's own functions are removed.
void define_functions(mu::Parser& parser) {
  using namespace mathematics;
  const auto one = [&](const char* name, double (*function)(double)) { parser.DefineFun(name, function); };
  const auto many = [&](const char* name, double (*function)(const double*, int)) { parser.DefineFun(name, function); };
  parser.ClearFun();
  one("sin", sine), one("cos", cosine), one("tan", tangent), one("asin", arc_sine), one("acos", arc_cosine);
  one("atan", arc_tangent), one("sinh", hyperbolic_sine), one("cosh", hyperbolic_cosine), one("tanh", hyperbolic_tangent);
  one("asinh", inverse_hyperbolic_sine), one("acosh", inverse_hyperbolic_cosine), one("atanh", inverse_hyperbolic_tangent);
  one("exp", exponential), one("ln", logarithm), one("log", logarithm), one("log2", logarithm_of_two);
  one("log10", logarithm_of_ten);
  one("sqrt", [](double x) { return std::sqrt(x); });
  one("abs", [](double x) { return std::abs(x); });
  one("rint", [](double x) { return std::floor(x + 0.5); });
  one("sign", [](double x) { return static_cast<double>((x > 0) - (x < 0)); });
  many("sum", [](const double* x, int count) { return std::accumulate(x, x + count, 0.0); });
  many("avg", [](const double* x, int count) { return std::accumulate(x, x + count, 0.0) / count; });
  many("min", [](const double* x, int count) { return *std::min_element(x, x + count); });
  many("max", [](const double* x, int count) { return *std::max_element(x, x + count); });
  parser.DefineFun("atan2", static_cast<double (*)(double, double)>(arc_tangent));
  parser.DefineOprtChars((std::string(parser.ValidOprtChars()) + kPowerSign).c_str());
  parser.DefineOprt(std::string(1, kPowerSign), power, mu::prPOW, mu::oaRIGHT, true);
}

struct Expression {
  struct In {
    std::string formula = "a";
    double a = 0, b = 0, c = 0, d = 0;
    std::string a_unit, b_unit, c_unit, d_unit, unit;
  };
  struct Out {
    double result = 0;
  };
  static constexpr std::array kValues = {&In::a, &In::b, &In::c, &In::d};
  static constexpr std::array kUnits = {&In::a_unit, &In::b_unit, &In::c_unit, &In::d_unit, &In::unit};

  static void declare(TypificationBuilder<Expression>& t) {
    t.id("expression").label("Expression");
    t.column(CanvasColumn::first).icon(Icon::step);
    t.doc(
        "Computes one number from up to four. Units are checked: a length can be added to a length only. A plain number in the "
        "formula gets a unit by multiplication, as in `a + 3*m`. Sines and similar functions take radians: write "
        "`sin(a/deg*_pi/180)`.");
    t.in(&In::formula, "formula")
        .doc(
            "At most 500 characters: a b c d, + - * / ^, comparisons, `x ? y : z`, sqrt, abs, min, max, sum, avg, exp, ln, sin, "
            "...");
    for (std::size_t i = 0; i < kInputs.size(); ++i) {
      const std::string name = kInputs[i], unit = name + "_unit";
      t.in(kValues[i], name)
          .unit_from(unit)
          .combine(CombineRule::blend)
          .doc("The number `" + name + "`, set by people or proposed by links.");
      t.in(kUnits[i], unit)
          .doc("Unit of `" + name + "` as a symbol, such as `m`, `m2`, `m3` or `EUR`; empty for a plain number.");
    }
    t.in(&In::unit, "unit").doc("Unit of the result as a symbol; empty for a plain number.");
    t.out(&Out::result, "result").unit_from("unit").doc("The result of the formula.");
  }

  static Result<Dimension> dimension_of(const std::string& symbol, const std::string& port) {
    const auto unit = stored_unit(symbol);
    if (!unit) return unit.error().within(port);
    return (*unit)->dimension;
  }

  // The parser with its variables: the inputs, and the symbols of units as quantities of one unit each.
  class Formula {
   public:
    explicit Formula(std::span<const Dimension, 4> dimensions) {
      define_functions(parser_);
      for (std::size_t i = 0; i < kInputs.size(); ++i) quantities_[kInputs[i]].dimension = dimensions[i];
      for (const UnitInfo& row : unit_table()) {
        const std::string symbol(row.symbol);
        if (symbol.empty() || symbol.find_first_of("%/") != std::string::npos || parser_.GetFunDef().contains(symbol)) continue;
        quantities_[symbol] = {row.scale, row.scale, row.dimension};
      }
      for (auto& [name, quantity] : quantities_) parser_.DefineVar(name, &quantity.scaled);
      parser_.DefineConst("_pi", 3.141592653589793);  // the parser's own have twelve digits
      parser_.DefineConst("_e", 2.718281828459045);
    }
    Formula(const Formula&) = delete;  // the parser points into quantities_

    Result<void> read(const std::string& text) {
      const auto refuse = [](const std::string& sentence) { return Error{ErrorCode::parse, "formula", sentence}; };
      if (text.find_first_not_of(' ') == std::string::npos) return refuse("the formula is empty: write one, such as `a + b`");
      if (std::ssize(text) > kLongestFormula)
        return refuse("the formula has " + std::to_string(text.size()) + " characters: shorten it to " +
                      std::to_string(kLongestFormula));
      for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
        if (i + 1 < text.size() && text[i + 1] == '=') ++i;
        else if (i == 0 || (text[i - 1] != '<' && text[i - 1] != '>' && text[i - 1] != '!'))
          return refuse("a formula changes nothing, so the `=` at character " + std::to_string(i + 1) +
                        " has no place; compare with `==`");
      }
      if (const std::size_t at = text.find(kPowerSign); at != std::string::npos)
        return refuse("the sign at character " + std::to_string(at + 1) + " cannot be seen: take it out");
      std::string readable = text;
      std::replace(readable.begin(), readable.end(), '^', kPowerSign);
      try {
        parser_.SetExpr(readable);
        int results = 0;
        parser_.Eval(results);
        if (results != 1) return refuse("a formula gives one number: take away the comma outside of brackets");
      } catch (const mu::ParserError& problem) { return refuse(sentence(problem)); }
      return {};
    }
    void set(std::size_t input, double value) { quantities_[kInputs[input]].value = value; }
    // The value with every quantity multiplied by 64 to the power that it has in `base`; nullptr: as it is.
    double value(std::int8_t Dimension::*base) {
      for (auto& [name, quantity] : quantities_)
        quantity.scaled = base == nullptr ? quantity.value : std::ldexp(quantity.value, kScaleBits * (quantity.dimension.*base));
      return parser_.Eval();
    }

   private:
    std::string sentence(const mu::ParserError& problem) const {
      std::string token = problem.GetToken().substr(0, problem.GetToken().find(' '));
      std::replace(token.begin(), token.end(), kPowerSign, '^');
      const std::string where = problem.GetPos() < 0 ? "" : " at character " + std::to_string(problem.GetPos() + 1);
      std::vector<std::string> names = keys_of(quantities_);
      for (const auto& [name, function] : parser_.GetFunDef()) names.push_back(name);
      switch (problem.GetCode()) {
        case mu::ecUNASSIGNABLE_TOKEN:
          if (token.starts_with('^')) return "the sign `^`" + where + " needs a value before it";
          if (parser_.GetFunDef().contains(token))
            return "the function `" + token + "`" + where + " needs its arguments in brackets";
          return "`" + token + "`" + where + " is no name or sign that is known" + did_you_mean(token, names);
        case mu::ecUNEXPECTED_EOF:
        case mu::ecMISSING_PARENS: return "the formula ends too early: complete it, and close its brackets";
        case mu::ecUNEXPECTED_OPERATOR: return "the sign `" + token + "`" + where + " needs a value before it";
        case mu::ecUNEXPECTED_VAL:
        case mu::ecUNEXPECTED_VAR:
        case mu::ecUNEXPECTED_FUN:
          return "`" + token + "`" + where + " follows another value: put a sign such as `*` between the two";
        case mu::ecTOO_FEW_PARAMS:
        case mu::ecTOO_MANY_PARAMS: return "the function `" + token + "` takes another number of arguments";
        default: return "the formula cannot be read" + where + ": check its signs, brackets and commas";
      }
    }

    struct Quantity {
      double value = 0, scaled = 0;
      Dimension dimension;
    };
    std::map<std::string, Quantity> quantities_;
    mu::Parser parser_;
  };

  // The power p with which the formula follows one base of units: rescaling the base by 64 rescales the result by 64^p.
  static Result<int> power_of(Formula& formula, std::size_t base, int expected) {
    Random random(7, base);
    std::vector<std::pair<double, double>> pairs;  // unchanged, rescaled; the first set holds the inputs
    for (int s = 0; s <= kSamples; ++s) {
      const double plain = formula.value(nullptr), scaled = formula.value(kBases[base]);
      if (std::isfinite(plain) && std::isfinite(scaled)) pairs.emplace_back(plain, scaled);
      for (std::size_t i = 0; i < kInputs.size(); ++i) {
        const double size = std::ldexp(random.uniform(1, 2), static_cast<int>(random.below(20)) - 6);
        formula.set(i, s % 2 == 0 || random.uniform() < 0.5 ? size : -size);
      }
    }
    if (pairs.empty())
      return Error{ErrorCode::not_finite, "formula",
                   "no numbers that were tried give a finite result: guard divisions and roots"};
    const auto fits = [&](int power) {
      return std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
        const double wanted = std::ldexp(pair.first, kScaleBits * power);
        return std::abs(pair.second - wanted) <= 1e-9 * std::max(std::abs(pair.second), std::abs(wanted));
      });
    };
    if (fits(expected)) return expected;
    for (int power = -kLargestPower; power <= kLargestPower; ++power)
      if (fits(power)) return power;
    return Error{ErrorCode::wrong_unit, "formula",
                 std::string("quantities of different units are added or compared: give plain numbers a unit, as in `3*") +
                     kBaseNames[base] + "`"};
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    std::array<Dimension, 5> dimensions;
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
      const auto dimension = dimension_of(in.*kUnits[i], i < 4 ? kInputs[i] + std::string("_unit") : "unit");
      if (!dimension) return dimension.error();
      dimensions[i] = *dimension;
    }
    Formula formula(std::span<const Dimension, 5>(dimensions).first<4>());
    if (auto read = formula.read(in.formula); !read) return read.error();
    std::string found;
    bool is_right = true;
    for (std::size_t b = 0; b < kBases.size(); ++b) {
      for (std::size_t i = 0; i < kInputs.size(); ++i) formula.set(i, in.*kValues[i]);
      const auto power = power_of(formula, b, dimensions[4].*kBases[b]);
      if (!power) return power.error();
      is_right = is_right && *power == dimensions[4].*kBases[b];
      if (*power != 0)
        found += (found.empty() ? "" : "·") + std::string(kBaseNames[b]) + (*power == 1 ? "" : std::to_string(*power));
    }
    if (!is_right)
      return Error{ErrorCode::wrong_unit, "unit",
                   "the formula gives " + (found.empty() ? "a plain number" : "`" + found + "`") + ", but the result is to be " +
                       (in.unit.empty() ? "a plain number" : "in `" + in.unit + "`") + ": change the formula or the unit"};
    for (std::size_t i = 0; i < kInputs.size(); ++i) formula.set(i, in.*kValues[i]);
    const double result = formula.value(nullptr);
    if (std::isfinite(result)) return Out{result};
    return Error{ErrorCode::not_finite, "formula",
                 "the formula gives no finite number: guard divisions and roots, as in `b > 0 ? a/b : 0`"};
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(expression, Expression)
