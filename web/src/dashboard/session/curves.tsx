// The angles of both arms over a session.
import { useMemo, useState } from "preact/hooks";
import type uPlot from "uplot";
import { type Curves, JOINTS, type Joint } from "../../api/types";
import { t } from "../../strings";
import { AFFECTED_LINE, AXIS, Chart, type ChartOptions, HEALTHY_LINE } from "../chart";
import { degrees, duration } from "../format";

const HEIGHT_PX = 260;

const OPTIONS: ChartOptions = {
  legend: { show: false },
  axes: [
    { ...AXIS, values: (_, splits) => splits.map(duration) },
    { ...AXIS, size: 52, values: (_, splits) => splits.map((angle) => `${angle}°`) },
  ],
  scales: { x: { time: false } },
  series: [{}, HEALTHY_LINE, AFFECTED_LINE],
};

export function SessionCurves({ curves }: { curves: Curves }) {
  const [joint, setJoint] = useState<Joint>("elevation");
  const data = useMemo(() => dataOf(curves, joint), [curves, joint]);
  return (
    <section class="card" data-testid="curves">
      <div class="heading">
        <h2>{t("curves.title")}</h2>
        <div class="row">
          <span class="key">{t("arm.healthy")}</span>
          <span class="key key-affected">{t("arm.affected")}</span>
        </div>
      </div>
      <div class="choices">
        {JOINTS.map((one) => (
          <button
            key={one}
            type="button"
            class="choice choice-low"
            aria-pressed={one === joint}
            onClick={() => setJoint(one)}
          >
            {t(`joint.${one}`)}
          </button>
        ))}
      </div>
      {curves.t_s.length === 0 ? (
        <p class="soft">{t("curves.none")}</p>
      ) : (
        <>
          <Chart options={OPTIONS} data={data} height={HEIGHT_PX} label={t(`joint.${joint}`)} />
          <p class="small soft">{t("curves.closer")}</p>
        </>
      )}
    </section>
  );
}

function dataOf(curves: Curves, joint: Joint): uPlot.AlignedData {
  const inDegrees = (angles: readonly (number | null)[]) =>
    angles.map((angle) => (angle === null ? null : degrees(angle)));
  return [curves.t_s, inDegrees(curves.healthy_rad[joint]), inDegrees(curves.affected_rad[joint])];
}
