// Which arm is affected: looked at, and confirmed on screen.
import { otherSide, type Patient, type Side } from "../../api/types";
import { t } from "../../strings";
import { ArmPicture } from "./arm-picture";

interface SideProps {
  patient: Patient;
  side: Side | null;
  onChoose: (side: Side) => void;
}

export function SideQuestion({ patient, side, onChoose }: SideProps) {
  const differs = side !== null && side === patient.healthy_side;
  return (
    <section class="question">
      <h3>{t("prepare.side")}</h3>
      <p class="soft">{t("prepare.side.hint")}</p>
      <div class="choices">
        {(["left", "right"] as const).map((one) => (
          <button
            key={one}
            type="button"
            class="choice"
            aria-pressed={side === one}
            onClick={() => onChoose(one)}
            data-testid={`confirm-side-${one}`}
          >
            <ArmPicture side={one} />
            {t(`prepare.side.${one}`)}
          </button>
        ))}
      </div>
      {differs && (
        <p class="notice" role="alert">
          {t("prepare.side.differs", { side: t(`side.${otherSide(patient.healthy_side)}`) })}
        </p>
      )}
    </section>
  );
}
