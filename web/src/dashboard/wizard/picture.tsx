// The live picture beside every step, and the sensors below it.
import { t } from "../../strings";
import type { Feed } from "../live/feed";
import { FloorPlan } from "../live/floor-plan";
import { Sensors } from "../live/sensors";
import { BodyPicture } from "./body-picture";
import type { Facts, Step } from "./steps";

interface Props {
  step: Step;
  facts: Facts;
  feed: Feed;
}

export function Picture({ step, facts, feed }: Props) {
  const isRoom = step === "sensors" || step === "person";
  return (
    <section class="wizard-picture" aria-label={t("wizard.picture")}>
      <figure class="card">{isRoom ? <Room facts={facts} /> : <Body step={step} facts={facts} feed={feed} />}</figure>
      <Sensors feed={feed} />
    </section>
  );
}

function Room({ facts }: { facts: Facts }) {
  const isPlaced = facts.people.some(({ place }) => place);
  return (
    <>
      {isPlaced ? (
        <FloorPlan people={facts.people} sensors={facts.sensors} />
      ) : (
        <p class="wizard-blank soft">{t("wizard.picture.nobody")}</p>
      )}
      <figcaption class="small soft">{t("wizard.picture.room")}</figcaption>
    </>
  );
}

function Body({ step, facts, feed }: Props) {
  const withSensors = step === "alignment";
  const withTrail = step === "range";
  const words = withSensors ? "seen" : withTrail ? "trail" : "behind";
  return (
    <>
      <BodyPicture feed={feed} affected={facts.affectedSide} withSensors={withSensors} withTrail={withTrail} />
      <figcaption class="small soft">
        <div class="row">
          <span class="key">{t("arm.healthy")}</span>
          <span class="key key-affected">{t("arm.affected")}</span>
        </div>
        {t(`wizard.picture.${words}`)}
      </figcaption>
    </>
  );
}
