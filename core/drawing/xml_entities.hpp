// Puts the entities that a document's own DOCTYPE declares into its text, which pugixml does not do. XML 1.0,
// section 4.4. Programs for drawing use them for styles and for names of vocabularies.
#pragma once

#include <string>

namespace unicursal::core {

/// Returns the document (UTF-8) with every reference to a declared entity replaced. Lines keep their numbers.
/// Throws ModelError if the entities nest without end or multiply the text too often.
std::string with_entities(const std::string& bytes, const std::string& file);

}  // namespace unicursal::core
