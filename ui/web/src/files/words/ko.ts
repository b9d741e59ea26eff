// The sentences of files in Korean.
import type { Text } from "../../words";
import type { FilesKey } from "./en";

export const ko: Record<FilesKey, Text> = {
  minutes_busy: "지금 다른 사람을 위해 회의록을 만들고 있습니다. 잠시 후 다시 시도하세요.",
  minutes_right: "방을 진행하는 사람만 회의록을 받습니다.",
  minutes_failed: "회의록을 만들지 못했습니다. 서버의 답: {why}",
  files_making: "파일을 만들고 있습니다 …",
  files_saved: "{file} 파일을 저장했습니다.",
  files_offline: "서버가 응답하지 않습니다. 연결되면 다시 시도하세요.",
  export_format: "형식",
  export_options: "옵션",
  export_save: "파일 저장",
  export_busy: "다른 사람의 파일을 만들고 있습니다. 잠시 후 다시 시도하세요.",
  export_right: "방의 진행자와 설계자만 계획 파일을 받을 수 있습니다.",
  export_failed: "파일을 만들지 못했습니다. 서버의 답: {why}",
};
