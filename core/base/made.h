// Made objects of any type: one part computes them from its data, and others read them.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <typeinfo>

namespace bl {

/// A type of made objects, with its name for people ("a domain").
struct MadeType {
  const std::type_info* type = nullptr;  ///< nullptr: none
  std::string_view name;
  bool operator==(const MadeType& other) const {
    return type == other.type || (type != nullptr && other.type != nullptr && *type == *other.type);
  }
};

/// T says what it is called: `static constexpr std::string_view kMadeName`.
template <class T>
MadeType made_type() {
  return {&typeid(T), T::kMadeName};
}

/// An immutable object with its type. It is made on the first read and shared by all readers, so that an unread object costs
/// nothing. Only the same object is equal.
class Made {
 public:
  Made() = default;
  /// `make` is a pure function of what it holds; it may give nullptr.
  template <class T>
  static Made of(std::function<std::shared_ptr<const T>()> make) {
    Made made;
    made.cell_ = std::make_shared<Cell>();
    made.cell_->type = made_type<T>();
    made.cell_->make = [make = std::move(make)]() -> std::shared_ptr<const void> { return make(); };
    return made;
  }

  /// The object; nullptr where there is none, or where it is of another type.
  template <class T>
  std::shared_ptr<const T> get() const {
    if (cell_ == nullptr || !(cell_->type == made_type<T>())) return nullptr;
    return std::static_pointer_cast<const T>(object());
  }
  MadeType type() const { return cell_ ? cell_->type : MadeType{}; }
  bool operator==(const Made&) const = default;

 private:
  struct Cell {
    MadeType type;
    std::function<std::shared_ptr<const void>()> make;  // let go once it was asked
    std::once_flag is_made;
    std::shared_ptr<const void> object;
  };

  const std::shared_ptr<const void>& object() const {
    std::call_once(cell_->is_made, [&] {
      cell_->object = cell_->make();
      cell_->make = nullptr;
    });
    return cell_->object;
  }

  std::shared_ptr<Cell> cell_;
};

}  // namespace bl
