// `export`: writes the proposal of a scene in the formats that other programs read.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/base/plural.h"
#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/export/write_files.h"
#include "core/graph/sums_of_now.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/live_run.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/settle_watch.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

namespace fs = std::filesystem;

Error bad(const std::string& place, const std::string& message, ErrorCode code = ErrorCode::parse) {
  return {code, place, message};
}

Result<std::vector<exporting::Order>> orders_of(const ExportOptions& options) {
  std::vector<std::string> ids;
  for (const auto& format : exporting::all_formats()) ids.push_back(format.id);
  if (options.formats.size() != options.outs.size())
    return bad("", "--format is given " + counted(options.formats.size(), "time") + ", --out " +
                       counted(options.outs.size(), "time") + ": give one pair for each file");
  std::vector<exporting::Order> orders;
  std::vector<const exporting::FormatDefinition*> formats;
  for (std::size_t k = 0; k < options.formats.size(); ++k) {
    const std::string& id = options.formats[k];
    exporting::Order order{exporting::find_format(id), options.outs[k], exporting::means_folder(options.outs[k]), {}};
    if (order.format == nullptr)
      return bad("--format",
                 "there is no format `" + id + "`" + did_you_mean(id, ids) + "; `behaviourlinks export --help` lists all",
                 ErrorCode::unknown_type);
    if (order.is_folder && !order.format->may_fill_folder)
      return bad("--out " + order.out, "is a folder, but " + id + " makes one file; name it, such as " +
                                           (fs::path(order.out) / ("proposal" + order.format->ending)).string());
    formats.push_back(order.format);
    orders.push_back(std::move(order));
  }
  if (auto known = exporting::check_option_names(formats, options.options); !known) return known.error();
  for (exporting::Order& order : orders) {
    auto values = exporting::option_values(*order.format, options.options);
    if (!values) return values.error();
    order.options = std::move(*values);
  }
  return orders;
}

struct Outcome {
  std::shared_ptr<const State> state;
  bool is_met = true;
};

// The state to export: as it is, or settled.
Outcome state_of(const ExportOptions& options, const SceneReading& reading) {
  auto session = Session::start(full_registry(), reading.scene, reading.state ? &*reading.state : nullptr, options.threads);
  if (!session) {
    print_error(options.scene, session.error());
    return {};
  }
  if (!options.is_settling) return {(*session)->look()};
  SettleWatch watch;
  const StopScope scope(is_interrupted);
  LiveRun recordings(options.scene, false, 0);
  Progress progress;
  std::shared_ptr<const State> before;
  for (long long done = 0; done < options.max_ticks && !is_interrupted() && !(*session)->state()->is_settled(); ++done) {
    before = (*session)->state();
    recordings.before_tick(**session);
    if (!(*session)->tick()) break;
    if (progress.is_due()) progress.show("tick " + std::to_string((*session)->state()->tick));
    if (watch.is_hopeless(*(*session)->state())) break;
  }
  progress.clear();
  const auto state = (*session)->state();
  print_line((state->is_settled() ? "settled" : "not settled: " + why_not_settled(*state, before.get(), watch)) + ", tick " +
             std::to_string(state->tick));
  return {state, state->is_settled()};
}

int fail(const std::string& file, const Error& error) {
  print_error(file, error);
  return kBadInput;
}

}  // namespace

int export_command(const ExportOptions& options) {
  const auto orders = orders_of(options);
  if (!orders) return fail("", orders.error());
  for (const exporting::Order& order : *orders)
    if (auto may = exporting::may_write_order(order); !may) return fail("--out", may.error());
  catch_interrupts();
  const auto reading = load_scene(options.scene);
  if (!reading) return kBadInput;
  const Outcome outcome = state_of(options, *reading);
  if (!outcome.state) return kBadInput;
  const State seen = with_sums_of_now(*outcome.state);
  const auto proposal = exporting::read_proposal(seen, fs::path(options.scene).filename().string());
  if (!proposal) return fail(options.scene, proposal.error());
  for (const exporting::Building& volume : proposal->shapeless)
    print_line("in tables only: " + volume.label + ": " + volume.why_shapeless, Colour::yellow);
  const char* page = std::getenv("BEHAVIOURLINKS_PAGE");
  const auto products = exporting::make_products(*orders, *proposal, page == nullptr ? "" : page);
  if (!products) return fail(options.scene, products.error());
  for (const std::string& note : products->notes) print_line(note, Colour::yellow);
  for (const Error& error : products->refused) print_error("", error);
  if (auto made = exporting::make_folders(*products); !made) return fail("--out", made.error());
  std::vector<std::string> paths;
  const auto written = exporting::write_products(*products, paths);
  for (const std::string& path : paths) print_line("written: " + path);
  if (!written) return fail("", written.error());
  if (is_interrupted()) return interrupt_exit_code();
  if (!products->refused.empty()) {
    print_line(
        how_many(products->refused.size(), "format") + " of " + std::to_string(orders->size()) + " cannot hold this proposal",
        Colour::yellow);
    return kBadInput;
  }
  return outcome.is_met ? kDone : kNotMet;
}

}  // namespace bl::cli
