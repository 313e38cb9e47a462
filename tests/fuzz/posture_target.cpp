#include "planner/posture_input.hpp"
#include "tests/fuzz/targets.hpp"

namespace surefoot::fuzz {

void posture(std::string_view bytes) {
  try {
    const terrain::Document document = terrain::Document::parse(bytes, "input");
    const auto contacts = planner::read_contacts(document.root(), 1, 3);
    expect(!contacts.empty() && contacts.size() <= 3, "as many contacts as were asked for");
    if (const terrain::Node* com = document.root().find("com")) planner::read_point(*com, "com");
  } catch (const terrain::InputError& fault) {
    expect_located(fault.what());
  }
}

}  // namespace surefoot::fuzz
