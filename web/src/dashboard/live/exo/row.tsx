// One joint of the exoskeleton: where it is and should be, what the drive and the arm do, how much help is given.
import type { Joint, LiveTick } from "../../../api/types";
import { t } from "../../../strings";
import { angleText, figure } from "../../format";
import { AngleBar, EffortBar } from "./bars";
import { isClamped } from "./clamps";
import type { Ends } from "./scale";

interface Props {
  joint: Joint;
  index: number;
  tick: LiveTick;
  clamped: readonly string[];
  device: Ends | undefined;
  softMarginRad: number;
}

export function JointRow({ joint, index, tick, clamped, device, softMarginRad }: Props) {
  const limits = tick.limits.find((one) => one.joint === joint);
  const { angle_rad, command_rad, torque_nm, interaction_nm = [], share = [] } = tick.exo;
  const [measured, commanded] = [angle_rad[index], command_rad[index]];
  return (
    <tr data-testid="exo-row" data-joint={joint}>
      <th scope="row">
        {t(`joint.${joint}.short`)}
        {isClamped(joint, clamped) && <Clamped />}
      </th>
      <td class="number" data-testid="exo-measured">
        {angleText(measured)}
      </td>
      <td class="number" data-testid="exo-commanded">
        {angleText(commanded)}
      </td>
      <td>{limits && <AngleBar {...{ limits, device, softMarginRad, measured, commanded }} />}</td>
      <td class="number" data-testid="exo-torque">
        {figure(torque_nm[index], 1)}
        <span class="exo-end"> ≤{t("exo.torque.limit", { limit: figure(limits?.torque_nm) })}</span>
      </td>
      <td data-testid="exo-effort">
        <EffortBar value={interaction_nm[index]} limit={limits?.resistance_nm} />
      </td>
      <td class="number">{percent(share[index])}</td>
    </tr>
  );
}

function Clamped() {
  return (
    <span class="exo-clamped" role="img" aria-label={t("exo.clamped")}>
      ⚠
    </span>
  );
}

function percent(share: number | undefined): string {
  return share === undefined ? "–" : `${figure(100 * share)} %`;
}
