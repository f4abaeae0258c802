import { describe, expect, it } from "vitest";
import type { LiveTick } from "../api/types";
import { reasonFor } from "./reason";

const sensors = [{ name: "left" }] as unknown as LiveTick["sensors"];
const held = (reason: string) => ({ reason, sensors, blockers: [] });

describe("reasonFor", () => {
  it.each([
    ["wang pressed hold", "play.reason.person"],
    ["No sensor sees the patient now.", "play.reason.unseen"],
    ["The healthy arm is not seen well enough to follow. A person resumes.", "play.reason.unseen"],
    ["The healthy arm's position is too uncertain.", "play.reason.unseen"],
    ["wang pressed pain", "play.reason.pain"],
    ["wang said that it hurts", "play.reason.pain"],
    ["The elbow resists with 7.1 N m; the arm is held softly.", "play.reason.resisted"],
    ["Nobody who is in charge is connected.", "play.reason.alone"],
    ["The service is silent; nobody could be heard.", "play.reason.alone"],
    ["wang took over from lin.", "play.reason.taken"],
    ["The control loop stood still for 0.20 s.", null],
  ])("says of a hold because of %j %s", (reason, key) => {
    expect(reasonFor("paused", held(reason))).toBe(key);
  });

  it("tells how to become ready", () => {
    const blockers = [
      "The healthy arm is too far from where the exoskeleton holds the other (elbow by 1.1 rad); bring it near.",
    ];
    expect(reasonFor("ready", { reason: "", sensors, blockers })).toBe("play.reason.apart");
  });

  it("says that no camera is connected before anything that follows from it", () => {
    const blockers = ["No sensor sees the patient now."];
    expect(reasonFor("ready", { reason: "", sensors: [], blockers })).toBe("play.reason.sensors");
  });

  it("leaves faults and stops to the therapist", () => {
    expect(reasonFor("fault", held("The elbow was measured outside the patient's range."))).toBeNull();
    expect(reasonFor("stopped", held("wang pressed stop"))).toBeNull();
  });
});
