// Gathers one binary glTF: the JSON parts by name, and the binary chunk.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "frame/frame.h"
#include "frame/gltf_format.h"
#include "frame/surface_look.h"

namespace brisance::gltf {

using Json = nlohmann::ordered_json;

class GlbWriter {
 public:
  /// Without looks, materials are names alone.
  explicit GlbWriter(const SurfaceLooks* looks = nullptr) : looks_(looks) {}

  /// The body's node, in its place, with its mesh; its number.
  int addNode(const FrameBody& body);
  /// Each accessor has a view of its own; all numbers are four bytes, so everything stays aligned. `target`: what the
  /// view is for, 0 where glTF has no word for that.
  template <class T>
  int addAccessor(const std::vector<T>& values, const char* type, int componentType, int target = 0) {
    const int view = addView(values.data(), values.size() * sizeof(T), target);
    accessors_.push_back(
        {{"bufferView", view}, {"componentType", componentType}, {"count", values.size()}, {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }
  /// Shapes that the mesh of a node may take (glTF 2.0, 3.7.2.2): how far its vertices lie from where they are.
  void addShapes(int node, const std::vector<std::vector<Vec3f>>& displacements);
  Json& accessor(int number) { return accessors_.at(number); }
  void addAnimation(Json animation) { animations_.push_back(std::move(animation)); }

  /// The whole file; the writer is empty afterwards.
  std::string finish();

 private:
  int addView(const void* bytes, std::size_t count, int target);
  int meshNumber(const FrameBody& body);
  void addMesh(const TriangleMesh& mesh, const FrameBody& body);
  Json addAttributes(const TriangleMesh& mesh);
  int addPositions(const std::vector<Vec3f>& positions);
  int addIndices(const std::vector<Triangle>& triangles);
  int materialNumber(const FrameBody& body, const std::string& part);
  Json describe(const NamedLook& named);
  void describeGlow(const SurfaceLook& look, const Json& texture, Json& material);
  Json pictureTexture(const std::filesystem::path& picture);
  void useExtension(Json& material, const char* name, Json content);

  const SurfaceLooks* looks_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(), accessors_ = Json::array(),
       views_ = Json::array(), animations_ = Json::array(), textures_ = Json::array(), images_ = Json::array();
  std::set<std::string> extensions_;
  std::string binary_;
  std::map<std::pair<const TriangleMesh*, std::string>, int> meshNumbers_;
  std::map<std::string, int> materialNumbers_;
  std::map<std::filesystem::path, int> textureNumbers_;
};

}  // namespace brisance::gltf
