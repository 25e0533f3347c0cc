#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "house/sources.h"

// Which folder may include which: the rooms of the house, and the picture of them in the documents.
namespace aqc {
namespace {

using Names = std::vector<std::string>;

struct Room {
  std::string name;  // a folder of include/ and src/, or a file without its ending
  Names may;         // rooms that it may include, besides itself
};

Names operator+(Names names, const Names& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

// The plainest first: a room may include only what stands before it, so that there is no circle.
const std::vector<Room>& rooms() {
  static const std::vector<Room> table = [] {
    const Names below_law = {"math", "parameters", "model", "reference"};
    const Names pilot = below_law + Names{"law", "law/switched", "flight"};
    const Names core = pilot + Names{"pilot", "simulation"};
    const Names drawing = core + Names{"report", "figures"};
    return std::vector<Room>{
        {"math", {}},
        {"parameters", {"math"}},
        {"model", {"math", "parameters"}},
        {"reference", {"math", "parameters"}},
        {"law", below_law},
        {"law/switched", below_law + Names{"law"}},
        {"law/composite", below_law + Names{"law"}},
        {"law/law_factory", {"parameters", "model", "law", "law/switched", "law/composite"}},
        {"flight", {"math", "model", "reference", "law", "law/switched"}},
        {"pilot", pilot},
        {"simulation", pilot + Names{"pilot"}},
        {"campaign", core},
        {"report", core},
        {"figures", core + Names{"report"}},
        {"apps", core + Names{"campaign", "report", "figures", "law/law_factory"}},
        {"ros/border", below_law + Names{"flight", "simulation"}},
        {"ros/controller", pilot + Names{"pilot", "law/law_factory", "ros/border"}},
        {"ros/simulation", drawing + Names{"ros/border"}},
        {"ros/waypoints", {"math", "model", "reference", "ros/border"}},
        {"ros/display", below_law + Names{"simulation", "figures", "ros/border"}},
    };
  }();
  return table;
}

const Room* find(const std::string& name) {
  for (const Room& room : rooms()) {
    if (room.name == name) return &room;
  }
  return nullptr;
}

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "nothing" : text;
}

// The room of a file given from include/adaptive_quadrotor_control/ or src/. A file with a room of
// its own comes before its folder; a folder that the table does not name is no room.
const Room* roomOf(const std::string& file) {
  const Room* own = find(file.substr(0, file.rfind('.')));
  return own != nullptr ? own : find(file.substr(0, file.rfind('/')));
}

std::string withoutRoot(const std::string& name) {
  return std::regex_replace(name, std::regex("^(include/)?(src/)?(adaptive_quadrotor_control/)?"),
                            "");
}

// What a file includes of this house, from include/adaptive_quadrotor_control/ or src/; not the
// messages, which stand in no room and which the core may not have anyway.
Names includesOf(const test::Source& source) {
  static const std::regex quoted(
      R"re(#\s*include\s*(?:"([^"]+)"|<(adaptive_quadrotor_control/[^>]+)>))re");
  static const std::regex message("adaptive_quadrotor_control/[A-Z]\\w*\\.h");
  Names found;
  for (std::sregex_iterator i(source.code.begin(), source.code.end(), quoted), end; i != end; ++i) {
    const std::string name = (*i)[1].matched ? (*i)[1] : (*i)[2];
    if (!std::regex_match(name, message)) found.push_back(withoutRoot(name));
  }
  return found;
}

TEST(Layers, HaveNoCircles) {
  Names before;
  for (const Room& room : rooms()) {
    for (const std::string& name : room.may) {
      EXPECT_TRUE(contains(before, name)) << room.name << " may include " << name
                                          << ", which does not stand before it in the table";
    }
    before.push_back(room.name);
  }
}

TEST(Layers, EveryFileStandsInARoom) {
  std::set<std::string> inhabited;
  for (const test::Source& source : test::sources()) {
    const Room* room = roomOf(withoutRoot(source.name));
    if (room != nullptr) inhabited.insert(room->name);
    EXPECT_NE(room, nullptr) << source.name << " stands in no room: give its folder a line in "
                             << "test/house/layers_test.cpp and in docs/architecture.md";
  }
  for (const Room& room : rooms()) EXPECT_EQ(inhabited.count(room.name), 1u) << room.name;
}

TEST(Layers, IncludeOnlyWhatTheyMay) {
  int arrows = 0;
  for (const test::Source& source : test::sources()) {
    const Room* room = roomOf(withoutRoot(source.name));
    if (room == nullptr) continue;  // told by EveryFileStandsInARoom
    for (const std::string& name : includesOf(source)) {
      const Room* other = roomOf(name);
      ASSERT_NE(other, nullptr) << source.name << " includes " << name << ", which is in no room";
      if (other == room) continue;
      ++arrows;
      EXPECT_TRUE(contains(room->may, other->name))
          << source.name << " includes " << name << ": " << room->name << " -> " << other->name
          << "; " << room->name << " may include " << joined(room->may);
    }
  }
  EXPECT_GT(arrows, 100);
}

// The border knows the simulator's services; a vehicle's nodelet must not compile it on the way.
TEST(Layers, ARealVehicleCompilesNoSimulator) {
  std::map<std::string, Names> includes;
  Names open;
  for (const test::Source& source : test::sources()) {
    const std::string name = withoutRoot(source.name);
    includes[name] = includesOf(source);
    if (name.rfind("ros/controller/", 0) == 0) open.push_back(name);
  }
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (!seen.insert(name).second) continue;
    EXPECT_FALSE(std::regex_search(name, std::regex("^(simulation|report|figures)/"))) << name;
    open = open + includes[name];
  }
  EXPECT_GT(seen.size(), 20u);
}

// Whether an arrow follows from others, by way of a third room.
bool follows(const std::string& from, const std::string& to) {
  const Names& may = find(from)->may;
  return std::any_of(may.begin(), may.end(), [&](const std::string& between) {
    return between != to && (contains(find(between)->may, to) || follows(between, to));
  });
}

// The rooms and the arrows that do not follow from others.
std::string picture() {
  const auto id = [](std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
  };
  std::ostringstream text;
  text << "```mermaid\ngraph BT\n";
  for (const Room& room : rooms()) {
    text << "  " << id(room.name) << "[\"" << room.name << "\"]\n";
    for (const std::string& name : room.may) {
      if (!follows(room.name, name)) text << "  " << id(room.name) << " --> " << id(name) << "\n";
    }
  }
  text << "```\n";
  return text.str();
}

TEST(Layers, AreWhatTheDocumentShows) {
  const std::string document = test::textOf("docs/architecture.md");
  const std::string drawn = "<!-- rooms -->\n" + picture() + "<!-- /rooms -->\n";
  EXPECT_NE(document.find(drawn), std::string::npos)
      << "docs/architecture.md does not show the rooms as they are; it should hold\n"
      << drawn;
  for (const Room& room : rooms()) {
    const std::string row = "\n| `" + room.name + "` | ";
    const std::size_t begin = document.find(row);
    ASSERT_NE(begin, std::string::npos) << "docs/architecture.md has no row of " << room.name;
    const std::string line = document.substr(begin + 1, document.find('\n', begin + 1) - begin - 1);
    const std::string told = " | " + joined(room.may) + " |";
    EXPECT_TRUE(line.size() > told.size() &&
                line.compare(line.size() - told.size(), told.size(), told) == 0)
        << "docs/architecture.md: the row of " << room.name << " must end with" << told;
  }
}

}  // namespace
}  // namespace aqc
