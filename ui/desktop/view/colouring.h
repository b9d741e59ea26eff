// What the volumes' colours say, and the legend that explains them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "ui/desktop/look/theme.h"
#include "ui/desktop/look/use_tone.h"
#include "ui/desktop/view/labels.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {

/// "use", "error", "tension", "fill", or a numeric port as "typification.port".
struct ColourChoice {
  std::string id, label;
};
/// All choices that say something of this state: the four first, then ports by name.
std::vector<ColourChoice> colour_choices(const SceneFacts& facts);

struct Legend {
  std::string title;
  struct Row {
    std::string label;
    Colour colour = 0;
  };
  std::vector<Row> rows;          ///< of categories
  std::vector<Colour> ramp;       ///< of numbers, from low to high; empty for categories
  std::string low, middle, high;  ///< what its ends and its middle stand for, with units
};

/// The uses of a scene for all panels: their order, which is that of the programme, then by name; and their colours, which follow
/// from their names alone and are kept here, because every frame asks for them.
class UseNumbers {
 public:
  explicit UseNumbers(const Scene& scene);
  /// Its place in that order, kNoUse for no name.
  std::size_t of(const std::string& use) const;
  /// As `tone_of_use` has it.
  std::size_t tone(const std::string& use) const;

 private:
  struct Row {
    std::size_t number = 0, tone = 0;
  };
  std::map<std::string, Row> rows_;
};

/// The numbers of the last scene, made anew only where a use has changed.
class UseMemo {
 public:
  const UseNumbers& of(const std::shared_ptr<const State>& state);
  /// Grows whenever they are made anew.
  std::uint64_t revision() const { return revision_; }

 private:
  std::uint64_t revision_ = 0;
  std::shared_ptr<const State> state_;
  std::optional<UseNumbers> numbers_;
};
/// The colour of a tone of `tone_of_use`.
Colour colour_of_use(const Theme& theme, std::size_t tone);

/// How a volume stands against what was asked for; bars, list and card share the colours.
enum class AccountTone { met, off, far };
AccountTone tone_of_account(const reading::Account& account, double tolerance);
Colour colour_of_account(const Theme& theme, AccountTone tone);

struct Colouring {
  std::vector<Colour> colours;  ///< as facts.volumes
  Legend legend;
};
Colouring colour_volumes(const SceneFacts& facts, const std::string& choice, const Theme& theme, const UseNumbers& numbers);
inline Colouring colour_volumes(const SceneFacts& facts, const std::string& choice, const Theme& theme) {
  return colour_volumes(facts, choice, theme, UseNumbers(facts.state->plan->scene));
}

/// Colours and choices of one state after another: where a volume's colour follows from itself alone, only those that have
/// changed are coloured again.
class ColourMemo {
 public:
  const std::vector<ColourChoice>& choices(const SceneFacts& facts);
  const Colouring& of(const std::shared_ptr<const SceneFacts>& facts, const std::string& choice, const Theme& theme);
  /// What was asked for last.
  const Colouring& last() const { return colouring_; }

 private:
  bool follow(const SceneFacts& facts, const Theme& theme, const UseNumbers& numbers);

  UseMemo uses_;
  std::shared_ptr<const SceneFacts> facts_;  ///< what `colouring_` is of, by this choice and on this ground
  std::string choice_;
  bool is_dark_ = false;
  std::uint64_t uses_revision_ = 0;
  Colouring colouring_;
  std::shared_ptr<const Dependents> chosen_from_;  ///< of the plan that `choices_` are of, and the nodes of its volumes
  std::vector<std::uint32_t> nodes_;
  std::vector<ColourChoice> choices_;
};

}  // namespace bl::desktop
