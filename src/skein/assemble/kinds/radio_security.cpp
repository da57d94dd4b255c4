// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/radio_security.h"

#include <fmt/format.h>

#include <utility>

#include "skein/assemble/kinds/ranges.h"
#include "skein/link/mavlink/signing_key_file.h"
#include "skein/role/terrain.h"

namespace skein::assemble {
namespace {

using communication::Attack;
using communication::FalseContent;
using communication::Flooder;
using communication::Jammer;
using communication::Replayer;
using communication::Spoofer;
using scenario::Fields;

constexpr scenario::Range kPeriod{.at_least = 0.001, .at_most = 86400};

Fields<Jammer> jammer_fields() {
  using T = Jammer;
  return Fields<T>()
      .number("duty", &T::duty, "Share of each period in which it sends noise.",
              {.above = 0, .at_most = 1})
      .duration_s("period_s", &T::period, "From one burst of noise to the next.",
                  kPeriod);
}

Fields<FlooderChoice> flooder_fields() {
  using T = FlooderChoice;
  return Fields<T>()
      .integer("bytes", [](T & t) -> auto& { return t.flooder.bytes; }, "Of each packet.",
               {.at_least = 1, .at_most = 65535})
      .number("rate_hz", [](T & t) -> auto& { return t.flooder.rate; },
              "Packets that it orders.", {.at_least = 0.001, .at_most = 10000})
      .text("to", &T::to, "Who is to acknowledge them; \"\": they are for all.");
}

Fields<SpooferChoice> spoofer_fields() {
  using T = SpooferChoice;
  return Fields<T>()
      .text("as", &T::as, "The entity in whose name it speaks.")
      .required()
      .text("to", &T::to, "The entity that it speaks to.")
      .required()
      .word("content", [](T & t) -> auto& { return t.spoofer.content; }, "What it says.",
            {{"report", FalseContent::kReport, "a report of `as`, from a false place"},
             {"team-position", FalseContent::kTeamPosition,
              "that `as` is at a false place"},
             {"return-home", FalseContent::kReturnHome,
              "an order to fly home, with a higher number than any in use"}})
      .vector("offset_m", &T::offset, "Of a false place from the true one.")
      .number("offset_up_m", &T::offset_up, "The same, upwards.",
              {.at_least = -1e5, .at_most = 1e5})
      .duration_s(
          "period_s", [](T & t) -> auto& { return t.spoofer.period; },
          "From one message to the next.", kPeriod);
}

Fields<ReplayerChoice> replayer_fields() {
  using T = ReplayerChoice;
  return Fields<T>()
      .duration_s("delay_s", [](T & t) -> auto& { return t.replayer.delay; },
                  "After it has heard a message it sends it again.",
                  {.at_least = 0.001, .at_most = 86400})
      .text("of", &T::of, "The entity whose messages it records; \"\": all.");
}

std::string error_of(const AttackChoice& attack) {
  const int kinds = attack.jammer.has_value() + attack.flooder.has_value() +
                    attack.spoofer.has_value() + attack.replayer.has_value();
  if (kinds == 1) return "";
  return fmt::format(
      "{} given: an attack is one of jammer, flooder, spoofer and replayer.",
      kinds == 0 ? "none is" : "several are");
}

// Turns the choices of a scenario into attacks on its radio.
class Maker {
 public:
  Maker(const RadioContext& context, const communication::MacProfile& mac)
      : context_(context), mac_(mac) {}

  Result<Attack> make(const AttackChoice& choice, std::size_t number) {
    at_ = fmt::format("radio.attacks[{}].", number);
    error_ = Error{};
    Attack attack;
    attack.name =
        choice.name.empty() ? fmt::format("attack {}", number + 1) : choice.name;
    attack.place =
        Vec3(choice.position.x(), choice.position.y(),
             -(context_.terrain->elevation_msl(choice.position) + choice.altitude_agl));
    attack.power_dbm = choice.power_dbm;
    attack.from = choice.from;
    attack.until = choice.until;
    if (choice.jammer)
      jam(*choice.jammer, attack);
    else if (choice.flooder)
      flood(*choice.flooder, attack);
    else if (choice.spoofer)
      spoof(*choice.spoofer, attack);
    else if (choice.replayer)
      replay(*choice.replayer, attack);
    if (!error_.message.empty()) return error_;
    return attack;
  }

 private:
  void jam(const Jammer& jammer, Attack& attack) {
    if (shares_medium("jammer")) attack.what = jammer;
  }

  void flood(const FlooderChoice& choice, Attack& attack) {
    if (choice.flooder.bytes > mac_.part_bytes)
      return fail(
          "flooder.bytes",
          fmt::format("{} is more than the {} that a frame of this radio carries.",
                      choice.flooder.bytes, mac_.part_bytes));
    Flooder flooder = choice.flooder;
    if (!choice.to.empty()) flooder.to = find("flooder.to", choice.to);
    attack.what = flooder;
  }

  void spoof(const SpooferChoice& choice, Attack& attack) {
    Spoofer spoofer = choice.spoofer;
    spoofer.as = find("spoofer.as", choice.as);
    spoofer.to = find("spoofer.to", choice.to);
    if (spoofer.as == spoofer.to)
      fail("spoofer.to", "it must be another entity than `as`.");
    spoofer.offset = Vec3(choice.offset.x(), choice.offset.y(), -choice.offset_up);
    attack.what = spoofer;
  }

  void replay(const ReplayerChoice& choice, Attack& attack) {
    if (!shares_medium("replayer")) return;
    Replayer replayer = choice.replayer;
    if (!choice.of.empty()) replayer.of = find("replayer.of", choice.of);
    attack.what = replayer;
  }

  // Of lines for each there is nothing to hear or to disturb.
  bool shares_medium(const char* key) {
    if (mac_.access != communication::AccessMethod::kDirect) return true;
    fail(key, "this radio's nodes share no medium (mac.access: direct).");
    return false;
  }

  EntityId find(const char* key, const std::string& name) {
    for (std::uint32_t k = 0; k < context_.entities; ++k)
      if (context_.name(EntityId{k}) == name) return EntityId{k};
    fail(key, fmt::format("there is no entity \"{}\".", name));
    return EntityId{};
  }

  void fail(const char* key, std::string message) {
    if (error_.message.empty())
      error_ = {ErrorCode::kBadInput, at_ + key, std::move(message), ""};
  }

  const RadioContext& context_;
  const communication::MacProfile& mac_;
  std::string at_;
  Error error_;
};

}  // namespace

Fields<AttackChoice> attack_fields() {
  using T = AttackChoice;
  return Fields<T>()
      .text("name", &T::name, "In events; \"\": \"attack\" and its number.")
      .point("position_m", &T::position, "Where it stands.")
      .required()
      .number("altitude_agl_m", &T::altitude_agl, "Of its antenna above the ground.",
              kNotNegative)
      .number("power_dbm", &T::power_dbm, "Its transmit power.",
              {.at_least = -100, .at_most = 80})
      .duration_s("at_s", &T::from, "When it begins.")
      .duration_s("until_s", &T::until, "When it ends; null: with the run.")
      .object("jammer", &T::jammer, jammer_fields(),
              "It sends noise: nobody can decode it, all sense it and suffer from it.")
      .object("flooder", &T::flooder, flooder_fields(),
              "It fills the air with packets by the rules of the medium.")
      .object("spoofer", &T::spoofer, spoofer_fields(),
              "It sends messages in the name of another.")
      .object("replayer", &T::replayer, replayer_fields(),
              "It sends messages that it has heard again.")
      .rule("jammer", error_of)
      .rule("until_s", [](const T& attack) -> std::string {
        if (!attack.until || *attack.until > attack.from) return "";
        return "must be later than at_s.";
      });
}

Fields<AuthenticationChoice> authentication_fields() {
  using T = AuthenticationChoice;
  return Fields<T>()
      .file(
          "key_file", &T::key_file,
          "With the team's key, 32 bytes or 64 hexadecimal digits, which nobody else may "
          "be able to read.")
      .required()
      .boolean(
          "required", &T::required,
          "Messages that are not authentic are refused; else they are reported only.");
}

Result<std::vector<Attack>> make_attacks(const std::vector<AttackChoice>& choices,
                                         const RadioContext& context,
                                         const communication::MacProfile& mac) {
  std::vector<Attack> attacks;
  Maker maker(context, mac);
  for (std::size_t k = 0; k < choices.size(); ++k) {
    auto made = maker.make(choices[k], k);
    if (!made) return made.error();
    attacks.push_back(std::move(made).value());
  }
  return attacks;
}

Result<communication::AuthenticationOptions> make_authentication(
    const AuthenticationChoice& choice) {
  const auto key = mavlink::read_signing_key(choice.key_file);
  if (!key) {
    Error error = key.error();
    error.message = error.place + ": " + error.message;
    error.place = "radio.authentication.key_file";
    return error;
  }
  return communication::AuthenticationOptions{key.value(), choice.required};
}

}  // namespace skein::assemble
