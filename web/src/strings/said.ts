// What the station and the service say in words of their own, in the language chosen. They speak English; a sentence
// that is not known here stays English, which is better than silence.
import { isKey, language, t } from "./index";

/** A sentence (without its full stop, any case at its head) and the Chinese for it; `{1}` is its first blank. */
const CHINESE: readonly [RegExp, string][] = [
  [/^no session is open$/, "没有进行中的治疗"],
  [/^the session names no patient$/, "治疗没有指定患者"],
  [/^the affected side has not been confirmed on screen$/, "尚未在屏幕上确认患侧"],
  [/^no limits of movement are set for this patient$/, "尚未设定该患者的活动限位"],
  [/^nobody has signed for the limits of movement$/, "活动限位尚无人确认"],
  [/^no sensor is aligned yet$/, "还没有传感器完成对齐"],
  [/^no sensor sees the patient now$/, "目前没有传感器看到患者"],
  [/^the healthy arm is not seen well enough to follow$/, "健侧手臂看得不够清楚，无法跟随"],
  [/^the healthy arm's position is too uncertain$/, "健侧手臂的位置不够确定"],
  [
    /^the healthy arm is too far from where the exoskeleton holds the other \((\w+) by ([\d.]+)°\); bring it near$/,
    "健侧手臂与外骨骼所处位置相差太远（{1}差 {2}°），请靠近",
  ],
  [
    /^the exoskeleton's (\w+) stands outside the patient's range; move it by hand$/,
    "外骨骼的“{1}”在患者范围之外，请用手移回",
  ],
  [/^the exoskeleton is still coming to rest$/, "外骨骼尚未停稳"],
  [/^the (\w+) was measured outside the patient's range$/, "测得“{1}”超出患者范围"],
  [/^the (\w+) was measured moving faster than allowed$/, "测得“{1}”运动过快"],
  [/^the drive's measurement is not usable .*$/, "驱动的测量值不可用"],
  [/^the service is silent; nobody could be heard$/, "服务没有响应，无法接收操作"],
  [/^the control loop stood still for ([\d.]+) s$/, "控制回路停顿了 {1} 秒"],
  [/^the last session is still being closed; try again in a moment$/, "上次治疗仍在关闭，请稍后再试"],
  [/^a person resumes$/, "请由人按“继续”"],
  [/^(.+) pressed stop$/, "{1} 按了“停止”"],
  [/^(.+) pressed hold$/, "{1} 按了“暂停”"],
  [/^(\w+): at the end of its range$/, "{1}：已到范围尽头"],
  [/^(\w+): slowed, its target is uncertain or old$/, "{1}：目标不确定或过时，已减速"],
  [/^(\w+): held, its target is uncertain or old$/, "{1}：目标不确定或过时，已保持"],
  [/^the control loop was late (\d+) times$/, "控制回路迟到 {1} 次"],
  [/^(\d+) messages from sensors could not be read$/, "有 {1} 条传感器消息无法读取"],
  [/^(\d+) datagrams were longer than a sensor's ever are$/, "有 {1} 个数据报过长"],
  [/^(\d+) datagrams came from senders that are not allowed$/, "有 {1} 个数据报来自未获准的发送者"],
  [/^(\d+) datagrams were lost: they came faster than can be read$/, "有 {1} 个数据报因来得太快而丢失"],
  [/^the body had to be found anew after an error.*$/, "出错后重新寻找人体"],
  [/^left and right were exchanged, put back$/, "左右互换，已纠正"],
  [/^left and right cannot be told, sided joints not used$/, "无法分辨左右，未使用两侧关节"],
  [/^left and right joints are exchanged; it is not used\..*$/, "左右关节互换，未使用。请在发送程序中改正关节名称"],
  [/^the picture is mirrored; it is not used\..*$/, "画面是镜像，未使用。请在发送程序中关闭镜像"],
  [
    /^it sends a mirror image of the person; it is not used\..*$/,
    "发送的是人的镜像，未使用。请关闭发送程序的镜像或自拍模式",
  ],
  [/^bones are ([\d.e+-]+) times as long as a person's.*$/, "骨骼长度为常人的 {1} 倍，未使用。请让发送程序使用米"],
  [/^the patient$/, "患者"],
  [/^nobody is followed yet$/, "尚未跟踪任何人"],
  [/^another person: seen beside the patient$/, "另一个人：曾与患者同时出现"],
  [/^another person: not where the patient is$/, "另一个人：不在患者所在的位置"],
  [/^another person: other bone lengths$/, "另一个人：骨骼长度不同"],
  [/^the sensor loses the body: it moves as nobody can$/, "传感器正在丢失人体：其运动不可能是人的动作"],
  [/^no joint of the body is seen$/, "看不到该人体的任何关节"],
  [/^another body is followed now$/, "现在跟踪的是另一个人"],
  [/^name or password is wrong$/, "用户名或密码错误"],
  [/^an account's name and its password$/, "账户的用户名和密码"],
  [/^type them again$/, "请重新输入"],
  [/^nobody is logged in$/, "尚未登录"],
  [/^too many wrong passwords$/, "密码错误次数过多"],
  [/^wait (\d+) seconds$/, "请等待 {1} 秒"],
  [/^a session is open already$/, "已有治疗正在进行"],
  [/^one session at a time$/, "一次只能进行一项治疗"],
  [/^end that session first$/, "请先结束该治疗"],
  [/^look at what the arm is waiting for$/, "请看手臂在等待什么"],
  [/^the station was restarted during this session$/, "治疗期间工作站重新启动过"],
  [/^end this session and open a new one$/, "请结束本次治疗，再开始新的"],
  [/^(.+)'s affected side is the (left|right), not the (left|right)$/, "{1} 的患侧是{2}侧，不是{3}侧"],
  [/^the side that the patient's page names$/, "与患者资料一致的一侧"],
  [
    /^look which arm is in the exoskeleton; correct the patient's healthy side if that is wrong$/,
    "请看外骨骼里是哪只手臂；若资料中的健侧有误请改正",
  ],
  [/^opened by (.+)$/, "由 {1} 开始"],
  [/^ended by (.+)$/, "由 {1} 结束"],
];

/** As the station's own sentences begin; a full stop alone may belong to "Dr.". */
const NEXT_SENTENCE = /\.\s+(?=(?:A|No|Nobody|The)\s)/;

/** What the service says, one sentence or several, in the language chosen and without the last full stop. */
export function said(words: string): string {
  const plain = inDegrees(words).replace(/\.$/, "");
  return language() === "zh" ? inChinese(plain) : plain;
}

/** The station reckons in radians, people do not. */
function inDegrees(words: string): string {
  return words.replace(
    /(\d+(?:\.\d+)?) rad\b/g,
    (_, angle: string) => `${Math.round((Number(angle) * 180) / Math.PI)}°`,
  );
}

export function inChinese(plain: string): string {
  return plain.split(NEXT_SENTENCE).map(oneInChinese).join("；");
}

function oneInChinese(plain: string): string {
  for (const [pattern, chinese] of CHINESE) {
    const found = new RegExp(pattern, "i").exec(plain);
    if (found) return chinese.replace(/\{(\d)\}/g, (_, blank: string) => word(found[Number(blank)] ?? ""));
  }
  return plain;
}

/** What stood in a blank: a joint or a side by its own name, a further sentence, or itself. */
function word(blank: string): string {
  for (const key of [`joint.${blank}.short`, `side.${blank}`]) {
    if (isKey(key)) return t(key);
  }
  return blank.includes(" ") ? inChinese(blank) : blank;
}
