#include "frame/body_file.h"

#include <nlohmann/json.hpp>

#include "base/check.h"
#include "base/durable_file.h"

namespace brisance {

namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity: what is not finite must have stopped the run before.
double finite(double value) {
  CHECK(std::isfinite(value), "{} in a frame", value);
  return value;
}

Json toJson(const Vec3d& v) { return {finite(v.x), finite(v.y), finite(v.z)}; }
Vec3d vectorFrom(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json toJson(const FrameBody& body) {
  const Quaternion& q = body.pose.orientation;
  Json json{{"name", body.name},
            {"position", toJson(body.pose.position)},
            {"orientation", {finite(q.w), finite(q.x), finite(q.y), finite(q.z)}},
            {"linear_velocity", toJson(body.linearVelocity)},
            {"angular_velocity", toJson(body.angularVelocity)},
            {"temperature", finite(body.temperature)}};
  if (body.shapeFrame > 0) json["shape_frame"] = body.shapeFrame;
  return json;
}

FrameBody bodyFrom(const Json& json) {
  const Json& q = json.at("orientation");
  FrameBody body;
  body.name = json.at("name").get<std::string>();
  body.pose.position = vectorFrom(json.at("position"));
  body.pose.orientation = {q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>()};
  body.linearVelocity = vectorFrom(json.at("linear_velocity"));
  body.angularVelocity = vectorFrom(json.at("angular_velocity"));
  body.temperature = json.at("temperature").get<double>();
  body.shapeFrame = json.value("shape_frame", 0);
  return body;
}

Json toJson(const Balance& balance) {
  return {{"in", balance.in}, {"gained", balance.gained}, {"out", balance.out}, {"lost", balance.lost}};
}

Balance balanceFrom(const Json& json) {
  return {json.at("in").get<double>(), json.at("gained").get<double>(), json.at("out").get<double>(),
          json.at("lost").get<double>()};
}

/// Calls `parse` on the JSON, whose complaints become one line.
void parseFile(const std::string& text, const std::string& fileName, const std::function<void(const Json&)>& parse) {
  try {
    parse(Json::parse(text));
  } catch (const Json::exception& error) {
    throw DamagedFile(
        fmt::format("{}: is no such file of this program ({}); simulate this frame again", fileName, error.what()));
  }
}

std::string asText(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string bodiesToJson(const Frame& frame) {
  Json bodies = Json::array();
  for (const FrameBody& body : frame.bodies) bodies.push_back(toJson(body));
  const Json root{{"frame", frame.index}, {"time", finite(frame.time)}, {"bodies", std::move(bodies)}};
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void bodiesFromJson(const std::string& text, const std::string& fileName, Frame& frame) {
  parseFile(text, fileName, [&](const Json& root) {
    frame.index = root.at("frame").get<int>();
    frame.time = root.at("time").get<double>();
    frame.bodies.clear();
    for (const Json& body : root.at("bodies")) frame.bodies.push_back(bodyFrom(body));
  });
}

std::string contentHash(const std::vector<FrameBody>& bodies) {
  ContentHash hash;
  for (const FrameBody& body : bodies) {
    const Vec3d &p = body.pose.position, &v = body.linearVelocity, &w = body.angularVelocity;
    const Quaternion& q = body.pose.orientation;
    const double values[] = {p.x, p.y, p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, w.x, w.y, w.z, body.temperature};
    hash.add(body.name);
    hash.add(values, sizeof values);
    if (body.shapeFrame > 0) hash.add(&body.shapeFrame, sizeof body.shapeFrame);
  }
  return hash.hex();
}

std::string reportToJson(const Frame& frame) {
  const StepReport& report = frame.report;
  const PressureReport& pressure = report.pressure;
  return asText({{"frame", frame.index},
                 {"time", frame.time},
                 {"substeps", report.substeps},
                 {"courant", report.courant},
                 {"divergence", report.divergence},
                 {"pressure",
                  {{"iterations", pressure.iterations},
                   {"residual", pressure.residual},
                   {"converged", pressure.converged},
                   {"sealed_pockets", pressure.sealedPockets},
                   {"removed_source", pressure.removedSource}}},
                 {"volume", toJson(report.volume)},
                 {"heat", toJson(report.heat)},
                 {"stage_seconds", report.stageSeconds}});
}

StepReport reportFromJson(const std::string& text, const std::string& fileName) {
  StepReport report;
  parseFile(text, fileName, [&](const Json& root) {
    const Json& pressure = root.at("pressure");
    report.substeps = root.at("substeps").get<int>();
    report.courant = root.at("courant").get<double>();
    report.divergence = root.at("divergence").get<double>();
    report.pressure = {pressure.at("iterations").get<int>(), pressure.at("residual").get<double>(),
                       pressure.at("converged").get<bool>(), pressure.value("sealed_pockets", 0),
                       pressure.value("removed_source", 0.0)};
    report.volume = balanceFrom(root.at("volume"));
    report.heat = balanceFrom(root.at("heat"));
    report.stageSeconds = root.at("stage_seconds").get<std::map<std::string, double>>();
  });
  return report;
}

}  // namespace brisance
