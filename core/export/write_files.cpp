// An existing file of another kind is somebody's work, and is not replaced.
#include "core/export/write_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/file/file_io.h"

namespace bl::exporting {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTailReach = 256;  // no end of a mark is longer

// Was the file exported in that format, or is it empty?
Result<bool> is_own(const std::string& path, const FormatDefinition& format) {
  std::ifstream file(path, std::ios::binary);
  const auto part = [&](std::size_t most) {
    std::string bytes(most, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(most));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
    return bytes;
  };
  const std::string head = part(kMarkReach);
  std::string tail = head;
  if (head.size() == kMarkReach) {
    file.clear();
    file.seekg(-static_cast<std::streamoff>(kTailReach), std::ios::end);
    tail = part(kTailReach);
  }
  if (!file.is_open() || file.bad())
    return Error{ErrorCode::io, path,
                 "exists already and cannot be read, so that nobody knows whether it was exported as " + format.id +
                     "; choose another name, or remove it first"};
  return head.empty() || has_mark(format, head, tail);
}

Result<void> may_replace(const std::string& path, const FormatDefinition& format) {
  // Devices and pipes take what they are given.
  if (std::error_code none; !fs::is_regular_file(path, none)) return {};
  const auto own = is_own(path, format);
  if (!own) return own.error();
  if (*own) return {};
  return Error{ErrorCode::conflict, path,
               "exists already and was not exported as " + format.id + "; choose another name, or remove it first"};
}

}  // namespace

namespace {

std::string lower_name(const std::string& path) {
  std::string name = fs::path(path).filename().string();
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return name;
}

// Programs choose by the ending how they read a file: that of another format would mislead them.
Result<void> ending_fits(const Order& order) {
  const std::string name = lower_name(order.out);
  if (name.ends_with(order.format->ending)) return {};
  for (const FormatDefinition& other : all_formats())
    if (name.ends_with(other.ending))
      return Error{ErrorCode::conflict, order.out,
                   "ends like files of the format " + other.id + ", and " + order.format->id + " is wanted: call it " +
                       fs::path(order.out).stem().string() + order.format->ending + ", or choose --format " + other.id};
  return {};
}

// An ending that is none of ours, and none at all, is somebody's choice, or a slip. Devices have none.
std::string note_on_ending(const Order& order) {
  const std::string& usual = order.format->ending;
  const std::string ending = fs::path(lower_name(order.out)).extension().string();
  std::error_code none;
  const bool is_device = fs::exists(order.out, none) && !fs::is_regular_file(order.out, none);
  const bool is_usual =
      !ending.empty() && (usual.find(ending) != std::string::npos || (ending == ".json" && usual == ".geojson"));
  if (order.is_folder || is_device || is_usual) return "";
  return order.format->id + ": " + order.out + " does not end with " + usual + ", by which programs know such files" +
         (ending.empty() && order.format->may_fill_folder ? "; a folder is named with a stroke at its end: " + order.out + "/"
                                                          : "");
}

// The nearest folder above that is there is one, and no file.
Result<void> may_make_folder(const std::string& out, const fs::path& folder) {
  std::error_code none;
  fs::path above = fs::absolute(folder, none).lexically_normal();
  while (!fs::exists(above, none) && above.has_relative_path()) above = above.parent_path();
  if (fs::is_directory(above, none)) {
    const auto may = may_write_file((above / fs::path(out).filename()).string());
    return may ? Result<void>() : Error{ErrorCode::io, out, may.error().message};
  }
  return Error{ErrorCode::io, out, "cannot be written: " + above.string() + " is a file, not a folder"};
}

}  // namespace

bool means_folder(const std::string& out) {
  std::error_code none;
  return out.ends_with('/') || fs::is_directory(out, none);
}

Result<void> may_write_order(const Order& order) {
  const fs::path path(order.out), folder = path.parent_path();
  std::error_code none;
  if (order.is_folder) {
    // The name without its stroke at the end: a file has none.
    const fs::path plain = path.has_filename() ? path : folder;
    if (fs::exists(plain, none) && !fs::is_directory(plain, none))
      return Error{ErrorCode::io, order.out, "is a file, not a folder; choose another name"};
    return {};
  }
  if (auto fits = ending_fits(order); !fits) return fits.error();
  if (!folder.empty() && !fs::is_directory(folder, none)) return may_make_folder(order.out, folder);
  if (auto may = may_replace(order.out, *order.format); !may) return may.error();
  return may_write_file(order.out);
}

namespace {

std::string shell_of(const FormatDefinition& format, const std::string& page_folder) {
  if (format.shell.empty() || page_folder.empty()) return "";
  const auto text = read_file((fs::path(page_folder) / format.shell).string());
  return text ? *text : "";
}

// A file of a folder that is there, so that none is written where another one cannot be.
Result<void> may_write_into(const std::string& path, const FormatDefinition& format) {
  if (auto may = may_replace(path, format); !may) return may.error();
  if (std::error_code none; !fs::is_directory(fs::path(path).parent_path(), none)) return {};
  return may_write_file(path);
}

constexpr std::size_t kNamedFiles = 4;

std::string some_of(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t k = 1; k < std::min(names.size(), kNamedFiles); ++k) text += ", " + names[k];
  return names.size() > kNamedFiles ? text + " and " + std::to_string(names.size() - kNamedFiles) + " more" : text;
}

// Of an earlier export into the same folder, ascending: who opens the folder takes them for a part of this one.
std::vector<std::string> left_over(const Order& order, const std::vector<ExportFile>& made) {
  std::vector<std::string> names;
  std::error_code none;
  for (fs::directory_iterator entry(order.out, none), end; !none && entry != end; entry.increment(none)) {
    const std::string name = entry->path().filename().string();
    const bool is_made = std::any_of(made.begin(), made.end(), [&](const ExportFile& file) { return file.name == name; });
    if (is_made || !name.ends_with(order.format->ending) || !fs::is_regular_file(entry->path(), none)) continue;
    if (const auto own = is_own(entry->path().string(), *order.format); own && *own) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Result<Products> make_products(std::span<const Order> orders, Proposal proposal, const std::string& page_folder) {
  Products products;
  std::map<std::string, std::string> taken;
  for (const Order& order : orders) {
    proposal.shell = shell_of(*order.format, page_folder);
    auto made = order.format->write(proposal, order.options, order.is_folder);
    if (!made) {
      products.refused.push_back(made.error().within(order.format->id));
      continue;
    }
    if (std::string note = note_on_ending(order); !note.empty()) products.notes.push_back(std::move(note));
    for (const std::string& note : made->notes) products.notes.push_back(order.format->id + ": " + note);
    const std::vector<std::string> others = order.is_folder ? left_over(order, made->files) : std::vector<std::string>{};
    if (!others.empty())
      products.notes.push_back(order.format->id + ": " + order.out + " also holds " + some_of(others) + " of an earlier export");
    for (ExportFile& file : made->files) {
      const std::string path = order.is_folder ? (fs::path(order.out) / file.name).string() : order.out;
      std::error_code none;
      if (!taken.emplace(fs::weakly_canonical(fs::absolute(path), none).string(), order.format->id).second)
        return Error{ErrorCode::conflict, path, "would be written twice in this call; choose another name or folder"};
      if (order.is_folder)
        if (auto may = may_write_into(path, *order.format); !may) return may.error();
      products.files.push_back({path, std::move(file.content)});
    }
  }
  return products;
}

std::vector<std::string> replaced_by(const Products& products) {
  std::vector<std::string> paths;
  for (const Product& product : products.files)
    if (std::error_code none; fs::is_regular_file(product.path, none)) paths.push_back(product.path);
  return paths;
}

Result<void> make_folders(const Products& products) {
  for (const Product& product : products.files) {
    const fs::path folder = fs::path(product.path).parent_path();
    if (folder.empty()) continue;
    std::error_code code;
    fs::create_directories(folder, code);
    if (std::error_code ignored; fs::is_directory(folder, ignored)) continue;
    return Error{ErrorCode::io, folder.string(),
                 "the folder cannot be made (" + (code ? code.message() : "a file of that name is there") + ")"};
  }
  return {};
}

Result<void> write_products(const Products& products, std::vector<std::string>& written) {
  for (const Product& product : products.files) {
    if (auto done = write_file(product.path, product.content); !done) return done.error();
    written.push_back(product.path);
  }
  return {};
}

}  // namespace bl::exporting
