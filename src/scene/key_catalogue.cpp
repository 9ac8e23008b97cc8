#include "scene/key_catalogue.h"

#include "scene/scene_keys.h"

namespace brisance {
namespace {

using Type = CatalogueEntry::Type;
using Kind = SceneNode::Kind;

SceneNode nodeOf(Kind kind) {
  SceneNode node;
  node.kind = kind;
  return node;
}

SceneNode textNode(const std::string& text) {
  SceneNode node = nodeOf(Kind::text);
  node.text = text;
  return node;
}

class Collector : public KeyVisitor {
 public:
  void flag(const Key& key, bool& value) override { add(key, Type::flag, nodeOf(Kind::flag)).value.flag = value; }
  void integers(const Key& key, std::span<std::int64_t> values) override {
    addArray(key, Type::integer, values.size(), [&](std::size_t i) {
      SceneNode node = nodeOf(Kind::integer);
      node.integer = values[i];
      return node;
    });
  }
  void numbers(const Key& key, std::span<double> values, Precision precision) override {
    addArray(key, Type::number, values.size(), [&](std::size_t i) {
      SceneNode node = nodeOf(Kind::number);
      node.number = values[i];
      node.singlePrecision = precision == Precision::single;
      return node;
    });
  }
  void places(const Key& key, std::vector<Vec2d>&) override { add(key, Type::places, nodeOf(Kind::array)); }
  void text(const Key& key, std::string& value) override { add(key, Type::text, textNode(value)); }
  void file(const Key& key, std::filesystem::path&) override { add(key, Type::file, textNode("")); }
  void choice(const Key& key, Names names, std::size_t& index) override {
    add(key, Type::choice, textNode(std::string(names[index]))).names.assign(names.begin(), names.end());
  }
  bool wants(const Key&, bool) override {
    nextIsOptional_ = true;
    return true;
  }

  void enter(const Key& key, bool typeAlone) override { open(key, Type::table).typeAlone = typeAlone; }
  void leave() override { close(); }
  std::size_t enterArray(const Key& key, std::size_t) override {
    open(key, Type::array);
    return 1;
  }
  void enterElement(std::size_t) override {}
  void leaveElement() override {}
  void leaveArray() override { close(); }
  std::vector<std::size_t> alternatives(Names names, std::size_t current) override {
    CatalogueEntry& table = open_.back();
    table.names.assign(names.begin(), names.end());
    table.value = textNode(table.names[current]);
    std::vector<std::size_t> all(names.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }
  void enterAlternative(std::size_t) override { open({"", "", anyValue, ""}, Type::table); }
  void leaveAlternative() override {
    std::vector<CatalogueEntry> keys = std::move(open_.back().children);
    open_.pop_back();
    open_.back().alternatives.push_back(std::move(keys));
  }

  CatalogueEntry root() { return open_.front(); }

 private:
  CatalogueEntry& add(const Key& key, Type type, SceneNode value) {
    CatalogueEntry entry;
    entry.key = key;
    entry.type = type;
    entry.optional = nextIsOptional_;
    entry.value = std::move(value);
    nextIsOptional_ = false;
    open_.back().children.push_back(std::move(entry));
    return open_.back().children.back();
  }
  template <class Make>
  void addArray(const Key& key, Type type, std::size_t count, const Make& make) {
    if (count == 1) {
      add(key, type, make(0));
      return;
    }
    CatalogueEntry& entry = add(key, type, nodeOf(Kind::array));
    entry.count = count;
    for (std::size_t i = 0; i < count; ++i) entry.value.children.push_back(make(i));
  }
  CatalogueEntry& open(const Key& key, Type type) {
    CatalogueEntry entry;
    entry.key = key;
    entry.type = type;
    open_.push_back(std::move(entry));
    return open_.back();
  }
  void close() {
    CatalogueEntry done = std::move(open_.back());
    open_.pop_back();
    open_.back().children.push_back(std::move(done));
  }

  std::vector<CatalogueEntry> open_{CatalogueEntry{}};  ///< from the root to the table being described
  bool nextIsOptional_ = false;
};

}  // namespace

CatalogueEntry catalogueOfKeys() {
  Collector collector;
  SceneDraft draft;
  describeScene(collector, draft);
  return collector.root();
}

}  // namespace brisance
