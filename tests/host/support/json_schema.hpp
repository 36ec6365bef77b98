// Holds values against JSON schemas (draft 2020-12), as far as host/daemon/schemas.json uses them. Stricter
// than the draft: a key that an object's schema does not list is a fault, unless it allows additional ones,
// so that a new key of an answer cannot stay undescribed. An unknown word in a schema is a fault, too.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace unicursal::test {

class SchemaCheck {
 public:
  /// `document`: in which "#/…" finds what is referred to.
  explicit SchemaCheck(const nlohmann::json& document) : document_(document) {}

  /// "status.print.layer: is not a number"; empty if everything is as it should be.
  std::vector<std::string> faults(const nlohmann::json& value, const nlohmann::json& schema,
                                  const std::string& at = {}) const {
    std::vector<std::string> found;
    check(value, schema, at, found);
    return found;
  }

 private:
  using json = nlohmann::json;
  using Faults = std::vector<std::string>;

  void check(const json& value, const json& schema, const std::string& at, Faults& found) const {
    for (const auto& [word, rule] : schema.items()) {
      if (word == "$ref") {
        check(value, document_.at(json::json_pointer(rule.get<std::string>().substr(1))), at, found);
      } else if (word == "type") {
        const auto is = [&](const json& one) { return is_of(value, one); };
        if (rule.is_array() ? std::none_of(rule.begin(), rule.end(), is) : !is(rule))
          found.push_back(at + ": is not of type " + rule.dump() + ": " + value.dump());
      } else if (word == "enum") {
        if (std::find(rule.begin(), rule.end(), value) == rule.end())
          found.push_back(at + ": is not one of " + rule.dump() + ": " + value.dump());
      } else if (word == "const") {
        if (value != rule) found.push_back(at + ": is not " + rule.dump());
      } else if (word == "anyOf") {
        const auto fits = [&](const json& one) { return faults(value, one, at).empty(); };
        if (std::none_of(rule.begin(), rule.end(), fits)) found.push_back(at + ": fits nowhere");
      } else if (word == "pattern") {
        if (value.is_string() &&
            !std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())))
          found.push_back(at + ": does not match " + rule.dump() + ": " + value.dump());
      } else if (word == "minItems" || word == "maxItems") {
        if (value.is_array() && (word == "minItems" ? value.size() < rule : value.size() > rule))
          found.push_back(at + ": has not as many items");
      } else if (word == "items") {
        for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
          check(value[i], rule, at + "[" + std::to_string(i) + "]", found);
      } else if (word == "required") {
        for (const json& key : rule) {
          if (value.is_object() && !value.contains(key.get<std::string>()))
            found.push_back(at + ": lacks " + key.dump());
        }
      } else if (word == "properties") {
        check_keys(value, schema, at, found);
      } else if (word != "description" && word != "additionalProperties") {
        found.push_back(at + ": the schema has an unknown word, " + word);
      }
    }
  }

  void check_keys(const json& value, const json& schema, const std::string& at, Faults& found) const {
    if (!value.is_object()) return;
    for (const auto& [key, held] : value.items()) {
      const std::string place = at.empty() ? key : at + "." + key;
      if (schema["properties"].contains(key))
        check(held, schema["properties"][key], place, found);
      else if (!schema.value("additionalProperties", false))
        found.push_back(place + ": is not described");
    }
  }

  static bool is_of(const json& value, const json& type) {
    const std::string name = type;
    if (name == "object") return value.is_object();
    if (name == "array") return value.is_array();
    if (name == "string") return value.is_string();
    if (name == "integer") return value.is_number_integer();
    if (name == "number") return value.is_number();
    if (name == "boolean") return value.is_boolean();
    return name == "null" && value.is_null();
  }

  const json& document_;
};

}  // namespace unicursal::test
