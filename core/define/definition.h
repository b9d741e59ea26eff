// Declarations as plain data: ports, typifications, link kinds and commands.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/base/unit.h"
#include "core/define/value.h"

namespace bl {

/// A cache for evaluations: of a set, for the next tick; of a link, for the other pairs of the same tick. It is no state: it is
/// neither saved nor hashed, and an evaluation must give the same bits with an empty one.
class Memo {
 public:
  /// The cached object, or a new T.
  template <class T>
  T& of() {
    static const char tag = 0;
    if (tag_ != &tag) held_ = std::make_shared<T>();
    tag_ = &tag;
    return *static_cast<T*>(held_.get());
  }

 private:
  std::shared_ptr<void> held_;
  const char* tag_ = nullptr;
};

struct LinkRemarks;

/// What an evaluation may read about the tick: its number and the thread pool. There is no clock and no order.
struct Tick {
  static constexpr std::int64_t kUnknown = -1;
  std::int64_t index = 0;          ///< kUnknown for types that do not declare that they read the time
  ThreadPool* pool = nullptr;      ///< only set evaluations (solvers) may use it; nullptr means one thread
  Memo* memo = nullptr;            ///< may be null; a set's lasts from tick to tick, a link's for one tick
  bool is_recall = false;          ///< only the meshes of the present values are needed: take no step
  LinkRemarks* remarks = nullptr;  ///< receives remarks of a link (link_remark.h); nullptr: remarks are ignored
};

/// How proposals on a port are combined (design: tick, phase 4). `sum` adds changes to the value; `collect` unites lists of
/// texts; `total` adds all proposals to what people have set, anew in each tick; the others choose a value.
enum class CombineRule { none, sum, blend, min, max, collect, total };
std::string_view name_of(CombineRule rule);

/// What the texts of a column are ids of. The check of a scene looks whether it is there; an empty text is no id. A row that
/// names a node and a port means that port of that node.
enum class NameOf { nothing, node, port, command };

/// Does each field of a column hold a list?
enum class ListOf { nothing, numbers, indices };

/// One column of a table port.
struct ColumnDefinition {
  std::string id;
  bool is_text = false;
  bool is_required = false;
  ListOf list = ListOf::nothing;
  bool is_key = false;  ///< a text that names the row, so that people can change different rows at the same time
  NameOf names = NameOf::nothing;
  Unit unit = Unit::none;
  Scalar default_value = 0.0;
  double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
  std::string doc;
};

struct ChoiceDefinition {
  std::string id, doc;
};

/// Does a port stand for the scene's setting of the same id: only where it is not set at the node, or always?
enum class OfScene { no, unless_set, always };

/// The column of the canvas for nodes without a place. Of a node's typifications, the one whose column comes first here decides.
enum class CanvasColumn { field, first, second, any };
/// The icon of a typification where there is no room for its label.
enum class Icon { link, file, balance, cycle, cube, plus, step };
/// Families of link kinds by their effect; links of one family look alike. `other`: none is declared, as in scripts and plugins;
/// `brief`: they connect no places.
enum class LinkFamily { nearness, separation, distance, order, numbers, data, ground, traffic, sun, facades, other, brief };

/// One declared datum of a typification, link kind or command.
struct PortDefinition {
  std::string id, doc;
  ValueKind kind = ValueKind::number;
  Unit unit = Unit::none;
  std::string unit_from;        ///< the port beside it that names the unit: a unit symbol, or a port whose unit it is
  bool is_computed = false;     ///< written by evaluations only; never set by people or links
  bool keeps_default = false;   ///< a set value is kept even if it equals the default, such as latitude 0
  bool is_required = false;     ///< has no usable default (ids in commands)
  bool is_residual = false;     ///< a scene is settled when every residual is within its tolerance
  bool reaches_out = false;     ///< makes the program that runs the scene open a file or a connection
  bool is_means = false;        ///< an inner quantity of a solver, which says nothing about the result: not compared
  bool is_shown_first = false;  ///< shown where there is room for few results; without such ports the first ones are
  bool is_traced = false;       ///< plotted where there is room for one curve only
  OfScene of_scene = OfScene::no;
  double setting_tolerance = 0;  ///< of a port that stands for a setting unless set: a larger difference is a problem
  CombineRule rule = CombineRule::none;
  double step_limit = std::numeric_limits<double>::infinity();  ///< largest change in one tick
  Value default_value = 0.0;
  double hard_minimum = -std::numeric_limits<double>::infinity(), hard_maximum = std::numeric_limits<double>::infinity();
  std::optional<double> soft_minimum, soft_maximum;
  std::vector<ChoiceDefinition> choices;
  std::vector<ColumnDefinition> columns;
  std::function<Value(const void*)> get;             ///< reads the bound member of its struct
  std::function<void(void*, const Value&)> set;      ///< writes it
  std::function<void(void*, const Value&)> recall;   ///< of a memory port: gives its last value to the settings struct
  MadeType made;                                     ///< of a port of made objects: their type
  std::vector<std::size_t> made_from;                ///< and the computed ports that they depend on
  std::function<Made(std::span<const Value>)> make;  ///< makes the object from all values of the typification, in order
};

/// Declarations are long lists of texts. These make the strings in one place, which nearly halves the code of a declaration.
void assign_text(std::string& place, std::string_view text);
PortDefinition& new_port(std::vector<PortDefinition>& ports, std::string_view id);

/// Gives a struct of settings the values of its ports, those of memory included; and takes the values of the computed ports, made
/// objects excluded, from a struct of results.
void set_members(const std::vector<PortDefinition>& ports, std::span<const Value> values, void* settings);
void get_members(const std::vector<PortDefinition>& ports, const void* results, std::span<Value> values);

/// `typification.port`, or the parameter that chooses it when `chosen_by` is set.
struct PortPath {
  std::string typification, port;
  std::string chosen_by;
};
/// "smart_volume.volume" split in two; nothing where there is no dot with text on both sides.
std::optional<PortPath> parse_port_path(std::string_view text);
/// Of a path in a declaration; a text that is no path ends the program.
PortPath port_path(std::string_view text);

/// A datum read from other nodes: its port, and the kind and unit that the reader expects.
struct ReadDefinition {
  PortPath path;
  ValueKind kind = ValueKind::number;
  MadeType made;             ///< the required type of a made object
  std::optional<Unit> unit;  ///< empty: any unit
  bool is_whole = false;     ///< gets the values of all nodes of its end at once
  std::function<void(void*, std::span<const Value* const>)> assign;
  /// Of a whole end, where all others are as they were assigned last: the values at these places.
  std::function<void(void*, std::span<const Value* const>, std::span<const std::uint32_t>)> assign_some;
};

/// Whole numbers and truth values can be read as numbers, and choices as texts.
bool can_read(ValueKind wanted, ValueKind held);

/// A datum written to other nodes: a proposal of a link, or a reply of a set evaluation.
struct WriteDefinition {
  PortPath path;
  ValueKind kind = ValueKind::number;
  std::optional<Unit> unit;
  bool is_whole = false;
  std::function<void(const void*, std::span<std::optional<Value>>)> extract;
};

/// The set of nodes that a typification evaluates together: the port that selects it, its reads, and its replies.
struct SetDefinition {
  std::string selection;  ///< id of the selecting input port
  std::vector<ReadDefinition> reads;
  std::vector<WriteDefinition> writes;
};

/// The values of one set at evaluation, row by row: member m's read r is reads[m * read_count + r].
struct SetValues {
  std::size_t members = 0;
  std::vector<Value> reads;
  /// Nothing is known of the last evaluation: all members are to be answered.
  bool is_anew = true;
  /// Else: whose reads differ from the last evaluation, or who has lost what it was replied then. All others read the same and
  /// still have their replies. Ascending.
  std::vector<std::uint32_t> changed;
  /// The members that get replies, where the evaluation answers some only; ascending. Nothing: all of them.
  std::optional<std::vector<std::uint32_t>> answered;
  std::vector<std::optional<Value>> writes;  ///< filled by the evaluation, row by row for those who are answered
  Memo loaded;                               ///< the reads as the evaluation wants them, from the last one

  /// Whose replies a row of `writes` holds.
  std::size_t member_of(std::size_t row) const { return answered ? (*answered)[row] : row; }
};

/// Changes values saved under an older revision; the JSON text in and out is the object of port values.
struct UpgradeDefinition {
  int from_revision = 0;
  std::string doc;
  std::function<Result<std::string>(const std::string&)> upgrade;
};

struct TypeDefinition {
  std::string id, label, doc;
  int revision = 1;
  std::vector<std::string> aliases;
  std::vector<UpgradeDefinition> upgrades;
  std::vector<PortDefinition> ports;  ///< settings first, computed ports after them
  bool reads_time = false;            ///< its result follows from the number of the tick as well: evaluated in every tick

  const PortDefinition* find_port(std::string_view port) const;
  std::size_t port_index(std::string_view port) const;  ///< ports.size() where there is none
};

/// The kind in words: "a number"; for made objects their type: "a domain".
std::string_view kind_text(ValueKind kind, const MadeType& made);
/// Makes the objects among `values` from the other values. An object is reused where all that it depends on is as in `last`.
void make_objects(const TypeDefinition& type, std::span<Value> values, std::span<const Value> last);

/// A role of a node. `evaluate` is empty for roles whose computed ports are written by a solver.
struct TypificationDefinition : TypeDefinition {
  CanvasColumn column = CanvasColumn::any;
  Icon icon = Icon::link;
  std::vector<SetDefinition> sets;
  /// Id of the port with the number of ticks after which a result counts; empty for evaluations within a tick.
  std::string latency;
  /// Reads the settings in `values` (all ports, in order), writes the computed ones; `sets` as declared.
  std::function<Result<void>(std::span<Value> values, std::span<SetValues> sets, const Tick&)> evaluate;
};

enum class End { from = 0, to = 1 };
std::string_view name_of(End end);

struct LinkRead : ReadDefinition {
  End end = End::from;
  bool is_lock = false;      ///< reads whether people have locked the port, not its value
  bool is_optional = false;  ///< nodes without the port fit the end all the same: nothing is read there
};
struct LinkWrite : WriteDefinition {
  End end = End::to;
  bool is_optional = false;  ///< nodes without the port fit the end all the same: what is proposed there is left out
};

/// What an evaluation keeps of the reads of whole ends until the next one, so that it takes over only what differs.
struct LoadedEnds {
  Memo memo;
  bool is_complete = false;                           ///< it holds all reads as they were in the last evaluation
  std::array<std::vector<std::uint32_t>, 2> changed;  ///< by end: places of nodes that may read otherwise since
};

/// The values for a link evaluation: one pointer per declared read, or one for each node of a whole end. Of an optional read,
/// nullptr where the node has no such port.
struct LinkReads {
  std::vector<std::vector<const Value*>> values;
  LoadedEnds* loaded = nullptr;  ///< nullptr: nothing is kept
};
struct LinkWrites {
  std::vector<std::vector<std::optional<Value>>> values;
};

/// The distances [m] between the two positions of a pair at which a link says nothing. There are none where `least` is above
/// `most`.
struct SilentBand {
  double least = 0, most = std::numeric_limits<double>::infinity();
  bool in_plan = false;  ///< heights do not count
};

/// A link kind. It is evaluated for each pair (from, to) of its ends; an end that is read or written `whole` counts once.
struct LinkDefinition : TypeDefinition {
  LinkFamily family = LinkFamily::other;
  std::vector<LinkRead> reads;
  std::vector<LinkWrite> proposes;
  std::vector<std::pair<std::string, std::string>> same_units;  ///< pairs of port parameters whose units must agree
  std::string same_units_unless;                                ///< a boolean parameter that disables that rule
  /// Its pairs share what they may use up in one tick, so that one can fail for what others took: all are evaluated together.
  bool has_common_budget = false;
  /// Where pairs are silent, by the parameters; empty: any pair may speak. Such pairs of large sets are not looked at.
  std::function<SilentBand(const void* parameters)> silent_band;
  std::array<std::size_t, 2> silent_reads{};  ///< where it is declared: the reads of the two positions, by end
  /// The parameters as a struct for the evaluation; made once per change of the link.
  std::function<std::shared_ptr<const void>(std::span<const Value>)> instantiate;
  std::function<Result<void>(const void* parameters, const LinkReads&, LinkWrites&, const Tick&)> evaluate;

  /// Does the link treat all nodes of this end in one evaluation?
  bool is_whole(End end) const;
};

}  // namespace bl
