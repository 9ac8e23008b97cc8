#include "scene/scene_keys.h"
#include "scene/scene_reader.h"

namespace brisance {
namespace {

using Kind = SceneNode::Kind;

class Writer : public KeyVisitor {
 public:
  void flag(const Key& key, bool& value) override { add(key.name, Kind::flag).flag = value; }
  void integers(const Key& key, std::span<std::int64_t> values) override {
    addArray(key, values.size(), Kind::integer, [&](SceneNode& node, std::size_t i) { node.integer = values[i]; });
  }
  void numbers(const Key& key, std::span<double> values, Precision precision) override {
    addArray(key, values.size(), Kind::number, [&](SceneNode& node, std::size_t i) {
      node.number = values[i];
      node.singlePrecision = precision == Precision::single;
    });
  }
  void places(const Key& key, std::vector<Vec2d>& values) override {
    SceneNode& array = add(key.name, Kind::array);
    for (const Vec2d& place : values) {
      array.children.push_back(fresh("", Kind::array));
      for (const double coordinate : {place.x, place.y}) {
        array.children.back().children.push_back(fresh("", Kind::number));
        array.children.back().children.back().number = coordinate;
      }
    }
  }
  void text(const Key& key, std::string& value) override { add(key.name, Kind::text).text = value; }
  void file(const Key& key, std::filesystem::path& value) override {
    add(key.name, Kind::text).text = value.generic_string();
  }
  void choice(const Key& key, Names names, std::size_t& index) override {
    add(key.name, Kind::text).text = std::string(names[index]);
  }
  bool wants(const Key&, bool hasValue) override { return hasValue; }

  void enter(const Key& key, bool) override { open(key.name, Kind::table); }
  void leave() override { close(); }
  std::size_t enterArray(const Key& key, std::size_t size) override {
    open(key.name, Kind::array);
    return size;
  }
  void enterElement(std::size_t) override { open("", Kind::table); }
  void leaveElement() override { close(); }
  /// An empty array is left out: it reads back as none.
  void leaveArray() override { close(); }
  std::vector<std::size_t> alternatives(Names names, std::size_t current) override {
    add("type", Kind::text).text = std::string(names[current]);
    return {current};
  }

  SceneNode root() { return open_.front(); }

 private:
  static SceneNode fresh(const std::string& key, Kind kind) {
    SceneNode node;
    node.key = key;
    node.kind = kind;
    return node;
  }
  SceneNode& add(const std::string& key, Kind kind) {
    open_.back().children.push_back(fresh(key, kind));
    return open_.back().children.back();
  }
  template <class Fill>
  void addArray(const Key& key, std::size_t count, Kind kind, const Fill& fill) {
    if (count == 1) return fill(add(key.name, kind), 0);
    SceneNode& array = add(key.name, Kind::array);
    for (std::size_t i = 0; i < count; ++i) {
      array.children.push_back(fresh("", kind));
      fill(array.children.back(), i);
    }
  }
  void open(const std::string& key, Kind kind) { open_.push_back(fresh(key, kind)); }
  void close() {
    SceneNode done = open_.back();
    open_.pop_back();
    if (done.kind != Kind::array || !done.children.empty()) open_.back().children.push_back(done);
  }

  std::vector<SceneNode> open_{SceneNode{}};  ///< from the root to the table being written
};

}  // namespace

SceneNode writeDraft(SceneDraft draft) {
  Writer writer;
  describeScene(writer, draft);
  return writer.root();
}

}  // namespace brisance
