// `export`: writes the proposal of a scene in the formats that other programs read.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/file/file_io.h"
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

// One pair of --format and --out.
struct Order {
  const exporting::FormatDefinition* format = nullptr;
  std::string out;
  bool is_folder = false;
  std::vector<Value> options;
};

struct Product {
  std::string path, content;
};

Error bad(const std::string& place, const std::string& message, ErrorCode code = ErrorCode::parse) {
  return {code, place, message};
}

// A folder that is there, or a name that ends like one.
bool means_folder(const std::string& out) {
  std::error_code none;
  return out.ends_with('/') || fs::is_directory(out, none);
}

Result<std::vector<Order>> orders_of(const ExportOptions& options) {
  std::vector<std::string> ids;
  for (const auto& format : exporting::all_formats()) ids.push_back(format.id);
  if (options.formats.size() != options.outs.size())
    return bad("", "--format is given " + counted(options.formats.size(), "time") + ", --out " +
                       counted(options.outs.size(), "time") + ": give one pair for each file");
  std::vector<Order> orders;
  std::vector<const exporting::FormatDefinition*> formats;
  for (std::size_t k = 0; k < options.formats.size(); ++k) {
    const std::string& id = options.formats[k];
    Order order{exporting::find_format(id), options.outs[k], means_folder(options.outs[k]), {}};
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
  for (Order& order : orders) {
    auto values = exporting::option_values(*order.format, options.options);
    if (!values) return values.error();
    order.options = std::move(*values);
  }
  return orders;
}

// An existing file of another kind is somebody's work.
Result<void> may_replace(const std::string& path, const exporting::FormatDefinition& format) {
  // Devices and pipes take what they are given.
  if (std::error_code none; !fs::is_regular_file(path, none)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string begin(256, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  if (begin.empty()) return {};
  for (const std::string& known : format.beginnings)
    if (begin.starts_with(known)) return {};
  return bad(path, "exists already and was not exported as " + format.id + "; choose another name, or remove it first",
             ErrorCode::conflict);
}

Result<void> may_write_order(const Order& order) {
  const fs::path path(order.out), folder = path.parent_path();
  std::error_code none;
  if (order.is_folder) {
    // The name without its stroke at the end: a file has none.
    const fs::path plain = path.has_filename() ? path : folder;
    if (fs::exists(plain, none) && !fs::is_directory(plain, none))
      return bad(order.out, "is a file, not a folder; choose another name", ErrorCode::io);
    return {};
  }
  if (!folder.empty() && !fs::is_directory(folder, none))
    return bad(order.out, "cannot be written: there is no folder " + folder.string(), ErrorCode::io);
  if (auto may = may_replace(order.out, *order.format); !may) return may.error();
  return may_write_file(order.out);
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
  if (!options.is_settling) return {(*session)->state()};
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
  print_line((state->is_settled() ? "settled" : "not settled: " + why_not_settled(*state, before.get())) + ", tick " +
             std::to_string(state->tick));
  return {state, state->is_settled()};
}

// The built page that a format is made of; empty where there is none, which the format says in its own words.
std::string shell_of(const exporting::FormatDefinition& format) {
  const char* folder = std::getenv("BEHAVIOURLINKS_PAGE");
  if (format.shell.empty() || folder == nullptr) return "";
  const auto text = read_file((fs::path(folder) / format.shell).string());
  return text ? *text : "";
}

// All contents are made before the first file is written: where a format refuses, nothing is.
Result<std::vector<Product>> make_products(const std::vector<Order>& orders, exporting::Proposal& proposal) {
  std::vector<Product> products;
  std::map<std::string, std::string> taken;
  for (const Order& order : orders) {
    proposal.shell = shell_of(*order.format);
    auto made = order.format->write(proposal, order.options, order.is_folder);
    if (!made) return made.error().within(order.format->id);
    for (const std::string& note : made->notes) print_line(order.format->id + ": " + note, Colour::yellow);
    for (exporting::ExportFile& file : made->files) {
      const std::string path = order.is_folder ? (fs::path(order.out) / file.name).string() : order.out;
      std::error_code none;
      if (!taken.emplace(fs::weakly_canonical(fs::absolute(path), none).string(), order.format->id).second)
        return bad(path, "would be written twice in this call; choose another name or folder", ErrorCode::conflict);
      if (auto may = may_replace(path, *order.format); !may && order.is_folder && path.ends_with(order.format->ending))
        return may.error();
      products.push_back({path, std::move(file.content)});
    }
  }
  return products;
}

Result<void> make_folders(const std::vector<Order>& orders) {
  for (const Order& order : orders) {
    if (!order.is_folder) continue;
    std::error_code code;
    fs::create_directories(order.out, code);
    if (std::error_code ignored; fs::is_directory(order.out, ignored)) continue;
    return bad(order.out, "the folder cannot be made (" + (code ? code.message() : "a file of that name is there") + ")",
               ErrorCode::io);
  }
  return {};
}

int fail(const std::string& file, const Error& error) {
  print_error(file, error);
  return kBadInput;
}

}  // namespace

int export_command(const ExportOptions& options) {
  const auto orders = orders_of(options);
  if (!orders) return fail("", orders.error());
  for (const Order& order : *orders)
    if (auto may = may_write_order(order); !may) return fail("--out", may.error());
  catch_interrupts();
  const auto reading = load_scene(options.scene);
  if (!reading) return kBadInput;
  const Outcome outcome = state_of(options, *reading);
  if (!outcome.state) return kBadInput;
  const State seen = with_sums_of_now(*outcome.state);
  auto proposal = exporting::read_proposal(seen, fs::path(options.scene).filename().string());
  if (!proposal) return fail(options.scene, proposal.error());
  for (const exporting::Building& volume : proposal->shapeless)
    print_line("in tables only: " + volume.label + ": " + volume.why_shapeless, Colour::yellow);
  const auto products = make_products(*orders, *proposal);
  if (!products) return fail(options.scene, products.error());
  if (auto made = make_folders(*orders); !made) return fail("--out", made.error());
  for (const Product& product : *products) {
    if (auto written = write_file(product.path, product.content); !written) return fail(product.path, written.error());
    print_line("written: " + product.path);
  }
  if (is_interrupted()) return interrupt_exit_code();
  return outcome.is_met ? kDone : kNotMet;
}

}  // namespace bl::cli
