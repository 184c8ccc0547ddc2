// A sheet may come from a file of another simulator. An importer puts what the file says under the keys of a
// sheet, and each number remembers its own name there. So one reader checks every sheet, and its complaints
// name the key of the user's file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::hwmodel {

class ForeignSheet {
 public:
  explicit ForeignSheet(const std::string& file)
      : file_(file), document_(table(file)), memory_(table(file + ": memory")) {}

  // `where` is the name of the number in the file.
  void put(const std::string& key, std::int64_t number, const std::string& where) {
    scene::Value value = at(where);
    value.kind = scene::Value::Kind::integer;
    value.integer = number;
    value.real = static_cast<double>(number);
    memory_.put(key, std::move(value));
  }
  void title(const std::string& text, const std::string& where) {
    scene::Value value = at(where);
    value.kind = scene::Value::Kind::text;
    value.text = text;
    document_.put("title", std::move(value));
  }
  // A supply has a name, and numbers that each have their name in the file.
  struct Number {
    std::string key;
    double value = 0;
    std::string where;
  };
  void rail(const std::string& name, const std::vector<Number>& numbers) {
    scene::Value rail = table(file_);
    scene::Value value = at(name);
    value.kind = scene::Value::Kind::text;
    value.text = name;
    rail.put("name", value);
    for (const Number& number : numbers) {
      value = at(number.where);
      value.kind = scene::Value::Kind::real;
      value.real = number.value;
      rail.put(number.key, value);
    }
    rails_.push_back(std::move(rail));
  }

  scene::Value document(int parts) {
    scene::Value document = document_;
    document.put("memory", memory_);
    if (rails_.empty()) return document;
    scene::Value power = table(file_), count = at("parts"), rails = at("rails");
    count.kind = scene::Value::Kind::integer;
    count.integer = parts;
    rails.kind = scene::Value::Kind::array;
    rails.items = rails_;
    power.put("parts", count);
    power.put("rail", rails);
    document.put("power", power);
    return document;
  }

 private:
  static scene::Value table(const std::string& name) {
    scene::Value value;
    value.place.origin = std::make_shared<const scene::Origin>(scene::Origin{name, {}, true});
    value.key_place = value.place;
    return value;
  }
  scene::Value at(const std::string& where) const { return table(file_ + ": " + where); }

  std::string file_;
  scene::Value document_, memory_;
  std::vector<scene::Value> rails_;
};

}  // namespace voxmelt::hwmodel
