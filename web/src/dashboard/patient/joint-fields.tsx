// What each joint may do: how far it may be moved, with how much torque, and how much resistance is too much.
import { JOINTS, type Joint, otherSide, type Side } from "../../api/types";
import { t } from "../../strings";
import { type JointDraft, LARGEST_DEG, LARGEST_NM, rangeDeg, torqueNm } from "./draft";
import type { PartProps } from "./form";
import { RangePicture } from "./range-picture";

export function JointFields({ draft, change }: PartProps) {
  const affected = otherSide(draft.healthySide ?? "left");
  return (
    <section class="card">
      <h2>{t("limits.title")}</h2>
      <p class="soft small">{t("range.why")}</p>
      <p class="soft small">{t("force.why")}</p>
      {JOINTS.map((joint) => (
        <JointField
          key={joint}
          joint={joint}
          side={affected}
          draft={draft.joints[joint]}
          onChange={(next) => change({ joints: { ...draft.joints, [joint]: next } })}
        />
      ))}
    </section>
  );
}

interface Props {
  joint: Joint;
  side: Side;
  draft: JointDraft;
  onChange: (draft: JointDraft) => void;
}

function JointField({ joint, side, draft, onChange }: Props) {
  const range = rangeDeg(draft);
  const [min, max] = range ?? [0, 0];
  const areTorques = torqueNm(draft.torque) !== null && torqueNm(draft.resistance) !== null;
  const field = (part: keyof JointDraft) => ({
    value: draft[part],
    onInput: (value: string) => onChange({ ...draft, [part]: value }),
    testId: `${joint}-${part}`,
  });
  return (
    <fieldset class="range" aria-label={t(`joint.${joint}`)}>
      <RangePicture joint={joint} side={side} sectors={[{ minDeg: min, maxDeg: max, look: "limit" }]} />
      <div class="field">
        <h3>{t(`joint.${joint}`)}</h3>
        <span class="hint">{t(`range.${joint}.hint`)}</span>
        <div class="range-inputs">
          <Degrees name={t("range.from")} {...field("min")} />
          <Degrees name={t("range.to")} {...field("max")} />
          <Torque name={t("force.torque")} {...field("torque")} />
          <Torque name={t("force.resistance")} {...field("resistance")} />
        </div>
        {!range && <span class="small caveat">{t("range.wrong")}</span>}
        {!areTorques && <span class="small caveat">{t("force.wrong", { largest: LARGEST_NM })}</span>}
      </div>
    </fieldset>
  );
}

interface NumberProps {
  name: string;
  value: string;
  onInput: (value: string) => void;
  testId: string;
}

function Degrees(props: NumberProps) {
  return <NumberField {...props} min={-LARGEST_DEG} max={LARGEST_DEG} step="1" />;
}

function Torque(props: NumberProps) {
  return <NumberField {...props} min={0} max={LARGEST_NM} step="any" />;
}

type FieldProps = NumberProps & { min: number; max: number; step: string };

function NumberField({ name, value, onInput, testId, ...bounds }: FieldProps) {
  return (
    <label class="hint">
      {name}
      <input
        type="number"
        {...bounds}
        value={value}
        onInput={(event) => onInput(event.currentTarget.value)}
        data-testid={testId}
      />
    </label>
  );
}
