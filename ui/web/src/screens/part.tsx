// A part of the page whose script comes when it is shown: what people see until it is here, and where it does not come.
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { PartName, part } from "../chunks";
import type { Session } from "../session";
import type { Ui } from "../ui";
import { language_now, t, words_now } from "../words";

export function Part({ s, ui, name }: { s: Session; ui: Ui; name: PartName }): JSX.Element {
  const box = useRef<HTMLDivElement>(null),
    end = useRef<() => void>(),
    [stage, set] = useState<"coming" | "here" | "lost">("coming"),
    [attempt, again] = useState(0),
    language = language_now();
  useEffect(() => {
    let isGone = false;
    part(name, language)
      .then(({ script, own }) => {
        if (isGone || !box.current) return;
        end.current = script.show(box.current, { s, ui, language, words: words_now(), own });
        set("here");
      })
      .catch(() => isGone || set("lost"));
    return () => {
      isGone = true;
    };
  }, [attempt, language]);
  useEffect(() => () => end.current?.(), []);
  const try_again = (): void => {
    set("coming");
    again(attempt + 1);
  };
  return (
    <>
      {stage === "here" ? null : (
        <div class="notice" role="status">
          <p>{t(stage === "lost" ? "part_lost" : "part_coming")}</p>
          {stage === "lost" ? (
            <div class="row">
              <button class="quiet" onClick={try_again}>
                {t("try_again")}
              </button>
              {attempt > 0 ? (
                <button class="quiet" onClick={() => window.location.reload()}>
                  {t("reload")}
                </button>
              ) : null}
            </div>
          ) : null}
        </div>
      )}
      <div class="part" ref={box} />
    </>
  );
}
