// The oracle query: what is answered, and that nothing improper gets an answer by guess.
#include "planner/query.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

using nlohmann::json;
using surefoot::planner::answer_query;

namespace {

const std::string flat = R"({"contacts": [{"p": [0,0], "n": [0,1], "mu": 0.5}, {"p": [1,0], "n": [0,2], "mu": 0.5}], )"
                         R"("com": [0.5,0.4], "rho": 0.2, "kappa": 0.17, "nu": 0.1})";

std::string answer(const std::string& line, std::size_t number = 1) {
  std::string out;
  answer_query(out, line, number);
  CHECK(out.find('\n') == std::string::npos);
  return out;
}

/// `flat` with one piece of text replaced.
std::string with(const std::string& piece, const std::string& other) {
  std::string line = flat;
  const auto at = line.find(piece);
  REQUIRE(at != std::string::npos);
  return line.replace(at, piece.size(), other);
}

std::string fault(const std::string& line) {
  INFO(line);
  const json parsed = json::parse(answer(line, 12));
  CHECK(parsed.size() == 2);
  CHECK(parsed["line"] == 12);
  return parsed["error"];
}

}  // namespace

TEST_CASE("A level stance that can only slip has the factor mu / kappa", "[query]") {
  // Tipping over a foot takes 0.5 = s (0.17 * 0.4 + 0.1), s = 2.976; slipping takes 0.5 = 0.17 s, s = 2.941.
  const json parsed = json::parse(answer(flat));
  CHECK(parsed["equilibrium"] == true);
  CHECK(parsed["robust"] == true);
  CHECK(parsed["safety_factor"].get<double>() == Approx(0.5 / 0.17).epsilon(1e-9));
  CHECK(parsed["feasible_modes"] == json::array());
}

TEST_CASE("How precisely the COM must be placed is told when asked for", "[query]") {
  CHECK_FALSE(json::parse(answer(flat)).contains("com_tolerance"));
  CHECK_FALSE(json::parse(answer(with("\"rho\"", "\"com_tolerance\": false, \"rho\""))).contains("com_tolerance"));
  // The nearest boundary is tipping over the left foot: x - 0.17 y = 0.1.
  const double distance = (0.5 - 0.17 * 0.4 - 0.1) / std::hypot(1, 0.17);
  const json parsed = json::parse(answer(with("\"rho\"", "\"com_tolerance\": true, \"rho\"")));
  CHECK(parsed["com_tolerance"].get<double>() <= distance * (1 + 1e-12));
  CHECK(parsed["com_tolerance"].get<double>() == Approx(distance).epsilon(1e-3));
  CHECK(fault(with("\"rho\"", "\"com_tolerance\": 1, \"rho\"")) == "com_tolerance: found 1, expected true or false");
  CHECK(fault(with("\"rho\"", "\"com_to\": [0, 1], \"com_tolerance\": true, \"rho\"")) ==
        "com_tolerance: a line has none, leave out com_to");
}

TEST_CASE("A level stance that tips first has the tipping factor, its witness and its gradient", "[query]") {
  // com (0.2, 0.4): 0.2 = s (0.17 * 0.4 + 0.1). d/dx: 1 / 0.168; d/dy: -0.2 * 0.17 / 0.168^2.
  const json parsed = json::parse(answer(with("[0.5,0.4]", "[0.2,0.4]")));
  const double sigma = 0.2 / 0.168;
  CHECK(parsed["safety_factor"].get<double>() == Approx(sigma).epsilon(1e-9));
  CHECK(std::abs(parsed["witness"][0].get<double>()) == Approx(0.17 * sigma).epsilon(1e-9));
  CHECK(std::abs(parsed["witness"][1].get<double>()) == Approx(0.1 * sigma).epsilon(1e-9));
  CHECK(parsed["gradient"][0].get<double>() == Approx(1 / 0.168).epsilon(1e-6));
  CHECK(parsed["gradient"][1].get<double>() == Approx(-0.2 * 0.17 / (0.168 * 0.168)).epsilon(1e-6));
}

TEST_CASE("A line is as safe as its least safe point", "[query]") {
  const json parsed = json::parse(answer(with(R"("rho")", R"("com_to": [0.2, 0.4], "rho")")));
  CHECK(parsed["robust"] == true);
  CHECK(parsed["safety_factor"].get<double>() == Approx(0.2 / 0.168).epsilon(1e-9));
  CHECK(parsed["lambda"].get<double>() == Approx(1));
  const json beyond = json::parse(answer(with(R"("rho")", R"("com_to": [-0.2, 0.4], "rho")")));
  CHECK(beyond["equilibrium"] == false);
  CHECK(beyond["robust"] == false);
  CHECK(beyond["safety_factor"] == 0.0);
}

TEST_CASE("Without disturbances a stable posture is safe without limit, written as a string", "[query]") {
  std::string line = with(R"("kappa": 0.17, "nu": 0.1)", R"("kappa": 0, "nu": 0)");
  CHECK(json::parse(answer(line))["safety_factor"] == "inf");
}

TEST_CASE("With restitution frictional stability and its margins are told, without it nothing of it", "[query]") {
  // Feet at distance b = 0.5, height h, rho = 0.2: psi = (b^2 - rho^2) / (b^2 + rho^2) = 21 / 29; kinematic-strong for
  // b h / (rho^2 + h^2) < mu = 0.5 < b / h, no h between 0 and 1 but below 0.0432: h = 0.04 gives 0.481.
  CHECK_FALSE(json::parse(answer(flat)).contains("frictional"));
  const std::string low = with("[0.5,0.4]", "[0.5,0.04]");
  CHECK_FALSE(json::parse(answer(low)).contains("psi"));
  const auto at = [](std::string line, const std::string& e) {
    return json::parse(answer(line.replace(line.find("\"rho\""), 5, "\"restitution\": " + e + ", \"rho\"")));
  };
  const json stable = at(low, "0.125"), high = at(flat, "0.125"), bouncy = at(low, "0.4");
  CHECK(stable["kinematic_strong"] == true);
  CHECK(stable["clattering"] == true);
  CHECK(stable["frictional"] == true);
  for (int i : {0, 1}) CHECK(stable["psi"][i].get<double>() == Approx(21.0 / 29).epsilon(1e-14));
  CHECK(stable["psi_margin"].get<double>() == Approx(21.0 / 29 - 2.0 / 3).epsilon(1e-12));  // threshold of 1/8: 2/3
  CHECK(stable["greatest_restitution"].get<double>() > 0.125);
  CHECK(stable["frictional_radius"].get<double>() > 0);
  CHECK(stable["frictional_radius"].get<double>() < 0.0032);  // the height limit
  CHECK_FALSE(stable.contains("failed_mode"));
  CHECK(high["kinematic_strong"] == false);
  CHECK(high["clattering"] == true);
  CHECK(high["frictional"] == false);
  CHECK(high["frictional_radius"] == 0.0);
  const std::string mode = high["failed_mode"];
  CHECK((mode == "RF" || mode == "FR"));
  CHECK(bouncy["kinematic_strong"] == true);
  CHECK(bouncy["clattering"] == false);
  CHECK(bouncy["psi_margin"].get<double>() < 0);
}

TEST_CASE("Answers begin with the promised keys in the promised order", "[query]") {
  const std::string text = answer(flat);
  std::size_t last = 0;
  for (const char* key :
       {"{\"equilibrium\": ", "\"robust\": ", "\"safety_factor\": ", "\"critical\": ", "\"feasible_modes\": ["}) {
    INFO(key);
    const std::size_t at = text.find(key, last);
    REQUIRE(at != std::string::npos);
    last = at;
  }
}

TEST_CASE("What is not a proper question is refused with its place", "[query]") {
  using Catch::Contains;
  CHECK_THAT(fault(""), Contains("empty line"));
  CHECK_THAT(fault("  \r"), Contains("empty line"));
  CHECK_THAT(fault("{"), Contains("not JSON"));
  CHECK_THAT(fault(flat.substr(0, flat.size() / 2)), Catch::EndsWith(" (a question stands on one line)"));
  CHECK_THAT(fault(flat + " x"), !Contains("on one line"));
  CHECK_THAT(fault("[1]"), Contains("JSON object"));
  CHECK_THAT(fault("12"), Contains("JSON object"));
  CHECK_THAT(fault(flat + " x"), Contains("not JSON"));
  CHECK_THAT(fault("\xff\xfe"), Contains("not JSON"));
  CHECK_THAT(fault(with("0.17", "NaN")), Contains("not JSON"));
  CHECK_THAT(fault(with("0.17", "1e999")), Contains("not JSON"));
  CHECK_THAT(fault(with("\"rho\"", "\"rhoo\"")), Contains("did you mean \"rho\""));
  CHECK_THAT(fault(with("\"rho\"", "\"radius\"")), Contains("expected one of: contacts, com, com_to, rho, kappa, nu"));
  CHECK_THAT(fault(with("\"mu\"", "\"m\"")), Contains("contacts[0]"));
  CHECK_THAT(fault(with("\"rho\"", "\"com\"")), Contains("twice"));
  CHECK_THAT(fault(with("\"p\": [0,0]", "\"p\": [0,0], \"p\": [0,0]")), Contains("twice"));
  CHECK_THAT(fault(with("\"rho\": 0.2, ", "")), Contains("rho is missing"));
  CHECK_THAT(fault(with("\"com\": [0.5,0.4], ", "")), Contains("com is missing"));
  CHECK_THAT(fault(with(", \"nu\": 0.1", "")), Contains("nu is missing"));
  CHECK_THAT(fault(with(", \"mu\": 0.5", "")), Contains("contacts[0].mu is missing"));
  CHECK_THAT(fault(with("\"mu\": 0.5", "\"mu\": -0.5")), Contains("contacts[0].mu: found -0.5"));
  CHECK_THAT(fault(with("\"rho\": 0.2", "\"rho\": 0")), Contains("rho: found 0"));
  CHECK_THAT(fault(with("0.17", "-0.17")), Contains("kappa: found -0.17"));
  CHECK_THAT(fault(with("0.17", "\"0.17\"")), Contains("a number"));
  CHECK_THAT(fault(with("0.17", "true")), Contains("a number"));
  CHECK_THAT(fault(with("[0,1]", "[0,0]")), Contains("contacts[0].n"));
  CHECK_THAT(fault(with("[0,1]", "[0,1,0]")), Contains("contacts[0].n"));
  CHECK_THAT(fault(with("[0,1]", "[0,null]")), Contains("contacts[0].n[1]"));
  CHECK_THAT(fault(with("[0.5,0.4]", "{}")), Contains("com"));
  CHECK_THAT(fault(with("\"rho\"", "\"restitution\": 1, \"rho\"")), Contains("between 0 and 1"));
  CHECK_THAT(fault(R"({"contacts": [], "com": [0,0], "rho": 1, "kappa": 0, "nu": 0})"), Contains("1 to 3 contacts"));
  const std::string contact = R"({"p": [0,0], "n": [0,1], "mu": 0.5})";
  CHECK_THAT(fault(R"({"contacts": [)" + contact + "," + contact + "," + contact + "," + contact +
                   R"(], "com": [0,0], "rho": 1, "kappa": 0, "nu": 0})"),
             Contains("1 to 3 contacts"));
}

TEST_CASE("Hostile lines are answered by an error, not by a crash", "[query]") {
  CHECK_FALSE(fault(std::string(100000, '[')).empty());
  CHECK_FALSE(fault(std::string(1000, '{')).empty());
  CHECK_FALSE(fault(std::string("{\"a\0b\": 1}", 10)).empty());
  CHECK(fault(R"({"contacts": ")" + std::string(5000, 'x') + "\"}").size() < 200);
  for (std::size_t cut = 0; cut < flat.size(); ++cut) CHECK_FALSE(fault(flat.substr(0, cut)).empty());
}

TEST_CASE("Extreme but finite numbers get a proper answer or an error", "[query]") {
  for (const char* number : {"1e300", "-1e300", "1e-320", "1e154", "0.0", "-0.0"})
    for (const char* piece : {"[0.5", "0.2,", "0.17", "0.1}", "[0,1]", "[1,0]", "0.5}"}) {
      std::string replacement = piece;
      const auto first = replacement.find_first_of("0123456789");
      const auto last = replacement.find_first_not_of("0123456789.", first);
      replacement.replace(first, (last == std::string::npos ? replacement.size() : last) - first, number);
      const std::string line = with(piece, replacement);
      INFO(line);
      CHECK(json::accept(answer(line)));
    }
}

TEST_CASE("A file of which no line is a question is told so once", "[query][program]") {
  const surefoot::tests::Workplace place;
  CHECK_THAT(place.run("query", "surefoot: 1\nname: x\n").err, Catch::Contains("none of the 2 lines is a question"));
  CHECK(place.run("query", "nonsense\n" + flat).err.empty());
  CHECK(place.run("query", "nonsense").err.empty());
}

TEST_CASE("The program answers every line in order and goes on after a bad one", "[query][program]") {
  const surefoot::tests::Workplace place;
  const std::string huge(2u << 20, 'x');
  const auto run = place.run("query", flat + "\n\nnonsense\n" + flat + "\r\n" + huge + "\n" + flat);
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  std::istringstream lines(run.out);
  std::vector<json> answers;
  for (std::string line; std::getline(lines, line);) answers.push_back(json::parse(line));
  REQUIRE(answers.size() == 6);
  CHECK(answers[0]["robust"] == true);
  CHECK(answers[1]["line"] == 2);
  CHECK(answers[2]["line"] == 3);
  CHECK(answers[3] == answers[0]);
  CHECK_THAT(answers[4]["error"].get<std::string>(), Catch::Contains("longer than"));
  CHECK(answers[5] == answers[0]);
}

TEST_CASE("An answer comes while the pipe stays open", "[query][program]") {
  // The shell sends the second question only after it has read the first answer.
  const surefoot::tests::Workplace place;
  place.write("question", flat + "\n");
  const auto run = place.shell("mkfifo to; '" SUREFOOT_BINARY
                               "' query <to | { exec 3>to; cat question >&3; timeout 20 head -n 1 >first; "
                               "cat question >&3; exec 3>&-; cat >second; }");
  CHECK(run.status == 0);
  CHECK(place.read("first").starts_with("{\"equilibrium\": true"));
  CHECK(place.read("first") == place.read("second"));
}

TEST_CASE("An empty input has no answers, and files that cannot be read are one error", "[query][program]") {
  const surefoot::tests::Workplace place;
  const auto none = place.run("query -");
  CHECK(none.status == 0);
  CHECK(none.out.empty());
  for (const char* file : {"missing.jsonl", "."}) {
    const auto run = place.run(std::string("query ") + file);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK(run.one_error());
  }
}

TEST_CASE("The statistics tell which decisions were exact", "[query][program]") {
  const surefoot::tests::Workplace place;
  // Count and exact decisions of the row that begins with `what`.
  const auto counts = [](const std::string& text, const std::string& what) {
    const auto at = text.find(what);
    REQUIRE(at != std::string::npos);
    std::istringstream numbers(text.substr(at + what.size()));
    std::pair<long, long> read{-1, -1};
    numbers >> read.first >> read.second;
    return read;
  };
  const auto plain = place.run("query", flat + "\n");
  const auto run = place.run("query --stats", flat + "\n");
  CHECK(plain.err.empty());
  CHECK(run.out == plain.out);
  // One question: equilibrium, robust verdict, modes; no facet is close to the COM.
  CHECK(counts(run.err, "facets of the equilibrium cone").first > 0);
  CHECK(counts(run.err, "facets of the equilibrium cone").second == 0);
  CHECK(counts(run.err, "modes at a COM").first > 0);
  CHECK(counts(run.err, "modes on an interval of a line").first == 0);
  // COM exactly on the facet of tipping over the left foot without disturbances: doubles cannot tell.
  const auto on_facet =
      place.run("query --stats", R"({"contacts": [{"p": [0,0], "n": [0,1], "mu": 0.5}, )"
                                 R"({"p": [1,0], "n": [0,1], "mu": 0.5}], "com": [0,0.4], "rho": 0.2, )"
                                 R"("kappa": 0, "nu": 0})"
                                 "\n");
  CHECK(counts(on_facet.err, "facets of the equilibrium cone").second > 0);
  CHECK(json::parse(on_facet.out)["equilibrium"] == false);
  CHECK(counts(place.run("query --stats", with("\"rho\"", "\"com_to\": [0.6, 0.4], \"rho\"") + "\n").err,
               "modes on an interval of a line")
            .first > 0);
}
