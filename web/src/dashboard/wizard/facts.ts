// The wizard's facts: the stream, read a few times a second, and what the therapist has answered.
import { otherSide, type Patient, type Side } from "../../api/types";
import { type Feed, useFromFeed } from "../live/feed";
import { peopleOf } from "../live/people";
import { type Choice, withChoice } from "./choice";
import type { Facts } from "./steps";

interface Answers {
  confirmedSide: Side | null;
  choice: Choice | null;
  isOpen: boolean;
  isRangeTaken: boolean;
}

export function useFacts(feed: Feed, patient: Patient, answers: Answers): Facts {
  const tick = useFromFeed(feed, 4, ({ newest, link }) => (link === "open" ? (newest?.tick ?? null) : null));
  const affectedSide = otherSide(patient.healthy_side);
  return {
    isConnected: tick !== null,
    sensors: tick?.sensors ?? [],
    people: withChoice(peopleOf(tick?.people ?? []), answers.choice),
    // an open session's side has been confirmed
    confirmedSide: answers.isOpen ? affectedSide : answers.confirmedSide,
    affectedSide,
    areLimitsSigned: patient.limits_set_by !== "",
    isOpen: answers.isOpen,
    isRangeTaken: answers.isRangeTaken,
    mayStart: tick?.may_enable === true,
  };
}
