// Pictures read as XML, for tests that look at what is drawn where.
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <functional>
#include <sstream>
#include <string>

namespace surefoot::gaits::testing {

inline boost::property_tree::ptree read_xml_text(const std::string& text) {
  std::istringstream stream(text);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(stream, tree);
  return tree;
}

/// All elements of a document in order, with their names.
inline void each_element(const boost::property_tree::ptree& tree,
                         const std::function<void(const std::string&, const boost::property_tree::ptree&)>& visit) {
  for (const auto& [name, child] : tree) {
    if (name == "<xmlattr>" || name == "<xmlcomment>") continue;
    visit(name, child);
    each_element(child, visit);
  }
}

}  // namespace surefoot::gaits::testing
