// Which files an export makes and where, and how they come onto the disk: all are made before the first is written.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/export/format.h"

namespace bl::exporting {

/// A format, and the file or folder that it goes to.
struct Order {
  const FormatDefinition* format = nullptr;
  std::string out;
  bool is_folder = false;
  std::vector<Value> options;  ///< one for each of the format's, in order
};

/// One file with all of its bytes.
struct Product {
  std::string path, content;
};

struct Products {
  std::vector<Product> files;
  std::vector<std::string> notes;  ///< with their formats: what these cannot hold or had to change
  std::vector<Error> refused;      ///< by formats that cannot hold the proposal, which are their places; the others are made
};

/// Is it a folder that is there, or a name that ends like one?
bool means_folder(const std::string& out);

/// What can be known before the work: is there a folder for the file, or can one be made, does its name end like files of another
/// format, can the file be written, and is it no work of somebody?
Result<void> may_write_order(const Order& order);

/// All files of all orders that their formats do not refuse. Where one of them may not be written, none is made; the place of the
/// error is its path.
/// `page_folder`: where the built page is that some formats are made of; empty where there is none, which the format says.
Result<Products> make_products(std::span<const Order> orders, Proposal proposal, const std::string& page_folder);

/// The paths of those that are on the disk already, which writing replaces.
std::vector<std::string> replaced_by(const Products& products);

/// Makes the folders of all files.
Result<void> make_folders(const Products& products);

/// Writes each file whole or not at all. `written` gets the paths of those that were, also where a later one fails.
Result<void> write_products(const Products& products, std::vector<std::string>& written);

}  // namespace bl::exporting
